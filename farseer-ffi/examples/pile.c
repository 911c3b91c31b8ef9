/* A pile, a ball, a double pendulum and a spring under both methods. Prints the bits of all positions and the hash of the state.
 * The test `pile` compares them with the same scene in Rust.
 *
 *     cargo build --release -p farseer-ffi
 *     gcc -o pile farseer-ffi/examples/pile.c -Ifarseer-ffi/include -Ltarget/release -lfarseer_ffi -lm
 *     LD_LIBRARY_PATH=target/release ./pile
 */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "farseer.h"

#define MAX_BODIES 64

/* Ends the program if a call was refused. */
static void check(FarseerStatus status) {
    if (status != FARSEER_STATUS_OK) {
        fprintf(stderr, "status %d: %s\n", (int)status, farseer_last_error());
        exit(1);
    }
}

static FarseerVector2 at(float x, float y) {
    FarseerVector2 vector = {x, y};
    return vector;
}

static FarseerBody add_box(FarseerSimulator *simulator, float width, float height, FarseerVector2 position) {
    FarseerBody body;
    FarseerGeom geom;
    check(farseer_body_create_rectangle(simulator, width, height, 1.0f, &body));
    check(farseer_body_set_position(simulator, body, position));
    check(farseer_geom_create_rectangle(simulator, body, width, height, NULL, &geom));
    check(farseer_geom_set_friction_coefficient(simulator, geom, 0.5f));
    return body;
}

static FarseerBody add_ball(FarseerSimulator *simulator, float radius, FarseerVector2 position) {
    FarseerBody body;
    FarseerGeom geom;
    check(farseer_body_create_circle(simulator, radius, 2.0f, &body));
    check(farseer_body_set_position(simulator, body, position));
    check(farseer_geom_create_circle(simulator, body, radius, 16, NULL, &geom));
    check(farseer_geom_set_restitution_coefficient(simulator, geom, 0.5f));
    return body;
}

static void add_wedge(FarseerSimulator *simulator) {
    FarseerVector2 corners[3] = {{-15.0f, 10.0f}, {15.0f, 10.0f}, {0.0f, -15.0f}};
    FarseerBodyOptions body;
    FarseerGeomOptions geom;
    FarseerBody id;
    check(farseer_body_options_default(&body));
    check(farseer_geom_options_default(&geom));
    body.position = at(60.0f, -100.0f);
    geom.shape = FARSEER_SHAPE_POLYGON;
    geom.points = corners;
    geom.point_count = 3;
    check(farseer_body_create(simulator, &body, &geom, 1, &id, NULL));
}

static void add_pendulum(FarseerSimulator *simulator) {
    FarseerJoint joint;
    FarseerBody upper = add_box(simulator, 10.0f, 40.0f, at(-150.0f, 60.0f));
    FarseerBody lower = add_box(simulator, 10.0f, 40.0f, at(-150.0f, 100.0f));
    check(farseer_joint_create_fixed_revolute(simulator, upper, at(-150.0f, 40.0f), &joint));
    check(farseer_joint_create_revolute(simulator, upper, lower, at(-150.0f, 80.0f), &joint));
    check(farseer_body_apply_impulse(simulator, lower, at(80.0f, 0.0f)));
}

static void add_spring(FarseerSimulator *simulator) {
    FarseerSpring spring;
    FarseerBody ball = add_ball(simulator, 8.0f, at(150.0f, 0.0f));
    check(farseer_spring_create_fixed_linear(simulator, ball, at(0.0f, 0.0f), at(150.0f, -50.0f), 20.0f, 0.5f, &spring));
}

static FarseerSimulator *scene(int32_t methods) {
    FarseerSimulator *simulator = farseer_simulator_create(methods, at(0.0f, 300.0f));
    if (simulator == NULL) {
        fprintf(stderr, "%s\n", farseer_last_error());
        exit(1);
    }
    FarseerBody floor = add_box(simulator, 400.0f, 20.0f, at(0.0f, 200.0f));
    check(farseer_body_set_is_static(simulator, floor, 1));
    for (int i = 0; i < 10; i++) {
        add_box(simulator, 20.0f, 20.0f, at(-40.0f + 25.0f * (float)(i % 4) + (float)i, 150.0f - 30.0f * (float)i));
    }
    FarseerBody ball = add_ball(simulator, 12.0f, at(5.0f, -200.0f));
    check(farseer_body_set_linear_velocity(simulator, ball, at(10.0f, 0.0f)));
    add_wedge(simulator);
    add_pendulum(simulator);
    add_spring(simulator);
    return simulator;
}

static void run(FarseerSimulator *simulator, int updates) {
    for (int i = 0; i < updates; i++) {
        check(farseer_simulator_update(simulator, 1.0f / 60.0f));
    }
}

static uint64_t hash(const FarseerSimulator *simulator) {
    uint64_t hash;
    check(farseer_simulator_state_hash(simulator, &hash));
    return hash;
}

static uint32_t bits(float value) {
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

static void print_bodies(const FarseerSimulator *simulator) {
    FarseerBody bodies[MAX_BODIES];
    FarseerVector2 positions[MAX_BODIES];
    float rotations[MAX_BODIES];
    size_t count;
    check(farseer_simulator_bodies(simulator, bodies, MAX_BODIES, &count));
    check(farseer_bodies_read(simulator, bodies, count, positions, rotations, NULL, NULL));
    for (size_t i = 0; i < count; i++) {
        printf("%08" PRIx32 " %08" PRIx32 " %08" PRIx32 "\n", bits(positions[i].x), bits(positions[i].y),
               bits(rotations[i]));
    }
}

static void print_events(const FarseerSimulator *simulator) {
    size_t count;
    check(farseer_simulator_events(simulator, NULL, 0, &count));
    printf("events %d\n", (int)count);
}

/* Goes back to a snapshot, and plays the last 100 updates again. */
static void play(const char *name, int32_t methods) {
    FarseerSimulator *simulator = scene(methods);
    size_t length;
    printf("%s\n", name);
    run(simulator, 200);
    check(farseer_simulator_take_snapshot(simulator, &length));
    uint8_t *snapshot = malloc(length);
    check(farseer_simulator_copy_snapshot(simulator, snapshot, length, &length));
    run(simulator, 100);
    printf("hash %016" PRIx64 "\n", hash(simulator));
    check(farseer_simulator_restore(simulator, snapshot, length));
    run(simulator, 100);
    printf("hash %016" PRIx64 "\n", hash(simulator));
    print_events(simulator);
    print_bodies(simulator);
    free(snapshot);
    farseer_simulator_destroy(simulator);
}

int main(void) {
    play("faithful", FARSEER_METHODS_FAITHFUL);
    play("precise", FARSEER_METHODS_PRECISE);
    return 0;
}
