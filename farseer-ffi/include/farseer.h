/* farseer-ffi: 2D rigid body physics, bit-exact to Farseer Physics 2.1.3, and the precise engine behind the same calls.
 *
 * Every function returns a status; FARSEER_STATUS_OK is 0. The reason of a refusal is farseer_last_error(). A refused call has changed nothing.
 * A pointer is null, which is refused, or points to aligned memory of its type that no other argument of the call overlaps.
 * Lengths are in your unit, y down; times in s; angles in radians. The README of the crate has the rules.
 */

#ifndef FARSEER_H
#define FARSEER_H

/* Generated from farseer-ffi/src by its test `header`. Do not edit. */

#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

// Result of a call. All but `FARSEER_STATUS_OK`, `_PANICKED` and `_BUFFER_TOO_SMALL` are refusals, which have changed nothing.
typedef enum {
  // The call was carried out.
  FARSEER_STATUS_OK = 0,
  // A pointer is null.
  FARSEER_STATUS_NULL_POINTER = 1,
  // An argument has a value that cannot be accepted: not finite, out of range, no value of its enum.
  FARSEER_STATUS_INVALID_ARGUMENT = 2,
  // An id names an object that was disposed.
  FARSEER_STATUS_STALE_ID = 3,
  // An id names an object of another kind, or no object.
  FARSEER_STATUS_WRONG_KIND = 4,
  // The chosen methods do not support it.
  FARSEER_STATUS_NOT_SUPPORTED = 5,
  // The call would cost more than the engine allows.
  FARSEER_STATUS_LIMIT_EXCEEDED = 6,
  // The bytes are no snapshot, were altered, or have another version.
  FARSEER_STATUS_DAMAGED_SNAPSHOT = 7,
  // The caller's array is too short: as many items as it has room for were written, and their full number.
  FARSEER_STATUS_BUFFER_TOO_SMALL = 8,
  // The call is not possible in the present state.
  FARSEER_STATUS_NOT_NOW = 9,
  // The engine panicked, in this call or an earlier one. The simulator refuses all further calls; destroy it.
  FARSEER_STATUS_PANICKED = 10,
} FarseerStatus;

// How a simulator computes.
typedef enum {
  // Farseer Physics 2.1.3, bit for bit.
  FARSEER_METHODS_FAITHFUL = 0,
  // The precise engine: faster and more accurate, with sleep and continuous collision.
  FARSEER_METHODS_PRECISE = 1,
} FarseerMethods;

// Which pairs may touch: the broad phase of the faithful methods. All four find the same pairs, in other orders.
typedef enum {
  // Sweeps along the better axis. The default.
  FARSEER_BROAD_PHASE_SELECTIVE_SWEEP = 0,
  // Sorted lists that are kept from update to update.
  FARSEER_BROAD_PHASE_SWEEP_AND_PRUNE = 1,
  // Tests all pairs.
  FARSEER_BROAD_PHASE_BRUTE_FORCE = 2,
  // A hashed grid, whose cells follow the sizes of the geoms.
  FARSEER_BROAD_PHASE_SPATIAL_HASH = 3,
} FarseerBroadPhase;

// Where pairs touch: the narrow phase of the faithful methods.
typedef enum {
  // A grid of distances for each outline. The default.
  FARSEER_NARROW_PHASE_DISTANCE_GRID = 0,
  // Separating axes, for convex outlines.
  FARSEER_NARROW_PHASE_SAT = 1,
} FarseerNarrowPhase;

// The friction coefficient of a pair.
typedef enum {
  // The mean of both coefficients. The default.
  FARSEER_FRICTION_AVERAGE = 0,
  // The smaller coefficient.
  FARSEER_FRICTION_MINIMUM = 1,
} FarseerFriction;

// Kinds of bodies.
typedef enum {
  // Forces and contacts move it.
  FARSEER_BODY_KIND_DYNAMIC = 0,
  // Its velocity alone moves it.
  FARSEER_BODY_KIND_KINEMATIC = 1,
  // It never moves.
  FARSEER_BODY_KIND_STATIC = 2,
} FarseerBodyKind;

// Shapes of geoms.
typedef enum {
  // `width` by `height`.
  FARSEER_SHAPE_RECTANGLE = 0,
  // `radius`.
  FARSEER_SHAPE_CIRCLE = 1,
  // Upright: `height` from tip to tip, `radius` of its ends.
  FARSEER_SHAPE_CAPSULE = 2,
  // The corners `points`, convex or not.
  FARSEER_SHAPE_POLYGON = 3,
  // Edges between the `points`, solid from one side, on a static body; under the precise methods.
  FARSEER_SHAPE_CHAIN = 4,
  // Edges between the `points`, solid from both sides, on a static body; under the precise methods.
  FARSEER_SHAPE_TWO_SIDED_CHAIN = 5,
  // The corners `points`, rounded by `radius`; under the precise methods.
  FARSEER_SHAPE_ROUNDED_POLYGON = 6,
} FarseerShape;

// Events that a geom wants, to be added up.
typedef enum {
  // No events.
  FARSEER_WANTED_EVENTS_NONE = 0,
  // Begin and end of touches.
  FARSEER_WANTED_EVENTS_TOUCH = 1,
  // Begin and end of overlaps with sensors.
  FARSEER_WANTED_EVENTS_SENSOR = 2,
  // Hits.
  FARSEER_WANTED_EVENTS_HIT = 4,
} FarseerWantedEvents;

// The kinds of events.
typedef enum {
  // Geom `first` touches geom `second`: one event for each side. In each update of a touch under the faithful methods, at its begin
  // under the precise ones.
  FARSEER_EVENT_KIND_COLLISION = 0,
  // Geom `first` does not touch geom `second` any more, or only their boxes overlap: one event for each side.
  FARSEER_EVENT_KIND_SEPARATION = 1,
  // Geoms `first` and `second` begin to touch: one event for the pair, if one of them wants it. This and the next three are events of
  // the precise methods.
  FARSEER_EVENT_KIND_TOUCH_BEGIN = 2,
  // Geoms `first` and `second` cease to touch.
  FARSEER_EVENT_KIND_TOUCH_END = 3,
  // Geom `second` begins to overlap the sensor `first`.
  FARSEER_EVENT_KIND_SENSOR_BEGIN = 4,
  // Geom `second` ceases to overlap the sensor `first`.
  FARSEER_EVENT_KIND_SENSOR_END = 5,
  // Body `first` fell asleep.
  FARSEER_EVENT_KIND_BODY_SLEPT = 6,
  // Body `first` is awake again.
  FARSEER_EVENT_KIND_BODY_WOKE = 7,
  // Body `first` was disposed.
  FARSEER_EVENT_KIND_BODY_DISPOSED = 8,
  // Object `first` entered the simulation.
  FARSEER_EVENT_KIND_ADDED = 9,
  // Object `first` left the simulation.
  FARSEER_EVENT_KIND_REMOVED = 10,
  // Joint `first` broke: it is disabled.
  FARSEER_EVENT_KIND_JOINT_BROKE = 11,
  // Spring `first` broke: it is disabled.
  FARSEER_EVENT_KIND_SPRING_BROKE = 12,
  // The state of the body, joint or spring `first` would not have been finite: a body was put back and disabled, a joint or
  // spring skipped.
  FARSEER_EVENT_KIND_NOT_FINITE = 13,
  // The engine ignored a value for the object `first`, 0 for the simulator.
  FARSEER_EVENT_KIND_REJECTED_INPUT = 14,
} FarseerEventKind;

// The kinds of joints.
typedef enum {
  // A kind that this interface does not have.
  FARSEER_JOINT_KIND_OTHER = 0,
  // A hinge between two bodies.
  FARSEER_JOINT_KIND_REVOLUTE = 1,
  // A hinge between a body and the world.
  FARSEER_JOINT_KIND_FIXED_REVOLUTE = 2,
  // A rod.
  FARSEER_JOINT_KIND_PIN = 3,
  // A range of distances.
  FARSEER_JOINT_KIND_SLIDER = 4,
  // A relative angle.
  FARSEER_JOINT_KIND_ANGLE = 5,
  // An angle of a body.
  FARSEER_JOINT_KIND_FIXED_ANGLE = 6,
  // A range of relative angles.
  FARSEER_JOINT_KIND_ANGLE_LIMIT = 7,
  // A range of angles of a body.
  FARSEER_JOINT_KIND_FIXED_ANGLE_LIMIT = 8,
  // A point and the relative angle.
  FARSEER_JOINT_KIND_WELD = 9,
  // A line and the relative angle.
  FARSEER_JOINT_KIND_PRISMATIC = 10,
  // A wheel with suspension.
  FARSEER_JOINT_KIND_WHEEL = 11,
  // A spring between angles.
  FARSEER_JOINT_KIND_ANGLE_SPRING = 12,
  // A bounded force to a pose.
  FARSEER_JOINT_KIND_MOTOR = 13,
  // Two bodies that turn in a ratio.
  FARSEER_JOINT_KIND_GEAR = 14,
  // A rope over two points.
  FARSEER_JOINT_KIND_PULLEY = 15,
} FarseerJointKind;

// A simulator. Threads may share it: its calls wait for each other.
typedef struct FarseerSimulator FarseerSimulator;

// Id of a body.
typedef uint64_t FarseerBody;

// A point, vector, velocity or force in the plane: x right, y down.
typedef struct {
  // Component to the right, in the unit of the quantity: length units for a point.
  float x;
  // Component down, in the unit of the quantity: length units for a point.
  float y;
} FarseerVector2;

// A body with its geoms for farseer_body_create. Start from farseer_body_options_default.
typedef struct {
  // Kind code: a FarseerBodyKind.
  int32_t kind;
  // Position in length units.
  FarseerVector2 position;
  // Rotation in radians.
  float rotation;
  // Velocity in length units/s.
  FarseerVector2 linear_velocity;
  // Angular velocity in rad/s.
  float angular_velocity;
  // Fraction of the velocity that is lost per s.
  float linear_damping;
  // Fraction of the angular velocity that is lost per s.
  float angular_damping;
  // Factor of gravity.
  float gravity_scale;
  // Mass in mass units; 0: that of the geoms.
  float mass;
  // Moment of inertia in mass units · length units²; 0: that of the geoms.
  float moment_of_inertia;
  // Flag: whether the body never turns.
  int32_t rotation_locked;
  // Flag: whether continuous collision acts against all bodies.
  int32_t bullet;
  // Flag: whether the body may fall asleep.
  int32_t sleep_allowed;
  // Flag: whether the body takes part.
  int32_t enabled;
  // A number of yours: the tag.
  uint64_t tag;
} FarseerBodyOptions;

// A geom for farseer_body_create and farseer_geom_create. Start from farseer_geom_options_default.
typedef struct {
  // Shape code: a FarseerShape.
  int32_t shape;
  // Width of a rectangle in length units.
  float width;
  // Height of a rectangle or a capsule in length units.
  float height;
  // Radius of a circle, of the ends of a capsule or of rounded corners, in length units.
  float radius;
  // Points of polygons and chains, in length units; read by the call alone.
  const FarseerVector2 *points;
  // Number of points.
  size_t point_count;
  // Position on the body in length units.
  FarseerVector2 offset;
  // Rotation relative to the body in radians.
  float rotation_offset;
  // Mass per square of a length unit; 0: the engine's default.
  float density;
  // Mass in mass units, instead of a density; 0: by the density.
  float mass;
  // Friction coefficient.
  float friction;
  // Restitution coefficient, 0 to 1.
  float restitution;
  // Bit mask: the categories of the geom.
  int32_t categories;
  // Bit mask: the categories that it collides with.
  int32_t collides_with;
  // Group number: geoms of one group other than 0 do not collide.
  int32_t group;
  // Flag: whether it is a sensor, which exerts no impulses.
  int32_t sensor;
  // Bit mask: a sum of FarseerWantedEvents; -1: touches and sensors under the precise methods.
  int32_t wanted_events;
  // A number of yours: the tag.
  uint64_t tag;
} FarseerGeomOptions;

// Id of a geom.
typedef uint64_t FarseerGeom;

// Id of an object of any kind; 0 is no object. Valid in the simulator that made it, and in those restored from its snapshots.
typedef uint64_t FarseerId;

// An event of the last update.
typedef struct {
  // Kind code: a FarseerEventKind.
  int32_t kind;
  // Number of contacts of a collision; else 0.
  uint32_t contacts;
  // The object of the event. Ids of disposed objects are stale.
  FarseerId first;
  // Id of the other geom; else 0.
  FarseerId second;
} FarseerEvent;

// Two geoms that hit each other, for example for a sound.
typedef struct {
  // Id of one geom.
  FarseerGeom geom1;
  // Id of the other geom.
  FarseerGeom geom2;
  // The contact point that closes fastest, in the world, in length units.
  FarseerVector2 point;
  // Unit normal from the first geom to the second.
  FarseerVector2 normal;
  // Speed along the normal before the impact, in length units/s.
  float speed;
} FarseerHit;

// A contact of a body.
typedef struct {
  // Id of the geom of the body.
  FarseerGeom geom;
  // Id of the other geom.
  FarseerGeom other;
  // The point in the world, in length units.
  FarseerVector2 point;
  // Unit normal from the other geom to the body: up for a body that stands.
  FarseerVector2 normal;
  // Separation in length units, negative for penetration.
  float separation;
  // Normal impulse of the last update, under the precise methods of its last substep, in mass units · length units/s.
  float normal_impulse;
} FarseerBodyContact;

// Place of a geom on its body. Zero in all fields, or null, is the body's origin.
typedef struct {
  // Position on the body in length units, before the geom is turned: the rotation turns it, too.
  FarseerVector2 offset;
  // Rotation relative to the body in radians.
  float rotation_offset;
  // Edge of a cell of the distance grid in length units; 0: a tenth of the shorter side.
  float collision_grid_size;
} FarseerPlacement;

// Id of a joint.
typedef uint64_t FarseerJoint;

// Id of a spring.
typedef uint64_t FarseerSpring;

// Which geoms a query finds. Start from farseer_query_filter_default.
typedef struct {
  // Bit mask: geoms of at least one of these categories are found.
  int32_t categories;
  // Bit mask: categories of the query itself, with which a geom has to collide.
  int32_t as_categories;
  // Flag: whether geoms of static bodies are found.
  int32_t static_bodies;
  // Flag: whether geoms of kinematic bodies are found.
  int32_t kinematic_bodies;
  // Flag: whether geoms of dynamic bodies are found.
  int32_t dynamic_bodies;
  // Flag: whether sensors are found.
  int32_t sensors;
  // Id of a body that is not found; 0 for none.
  FarseerBody exclude_body;
  // Id of a geom that is not found; 0 for none.
  FarseerGeom exclude_geom;
} FarseerQueryFilter;

// The point at which a ray enters a geom.
typedef struct {
  // Id of the geom.
  FarseerGeom geom;
  // The point in the world, in length units.
  FarseerVector2 point;
  // Outward unit normal at the point.
  FarseerVector2 normal;
  // Fraction of the distance from start to end, 0 to 1.
  float fraction;
} FarseerRayHit;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

// Writes the position of the body's origin in length units.
FarseerStatus farseer_body_position(const FarseerSimulator *simulator, FarseerBody body, FarseerVector2 *position);

// Sets the position of the body's origin in length units.
FarseerStatus farseer_body_set_position(const FarseerSimulator *simulator, FarseerBody body, FarseerVector2 position);

// Writes the rotation in radians, from 0 to a full turn.
FarseerStatus farseer_body_rotation(const FarseerSimulator *simulator, FarseerBody body, float *rotation);

// Sets the rotation in radians, from 0 to a full turn.
FarseerStatus farseer_body_set_rotation(const FarseerSimulator *simulator, FarseerBody body, float rotation);

// Writes the rotation in radians with all turns.
FarseerStatus farseer_body_total_rotation(const FarseerSimulator *simulator, FarseerBody body, float *total_rotation);

// Writes the velocity of the origin in length units/s.
FarseerStatus farseer_body_linear_velocity(const FarseerSimulator *simulator,
                                           FarseerBody body,
                                           FarseerVector2 *linear_velocity);

// Sets the velocity of the origin in length units/s.
FarseerStatus farseer_body_set_linear_velocity(const FarseerSimulator *simulator,
                                               FarseerBody body,
                                               FarseerVector2 linear_velocity);

// Writes the angular velocity in rad/s, clockwise on the screen.
FarseerStatus farseer_body_angular_velocity(const FarseerSimulator *simulator,
                                            FarseerBody body,
                                            float *angular_velocity);

// Sets the angular velocity in rad/s, clockwise on the screen.
FarseerStatus farseer_body_set_angular_velocity(const FarseerSimulator *simulator,
                                                FarseerBody body,
                                                float angular_velocity);

// Writes the mass in mass units, not 0.
FarseerStatus farseer_body_mass(const FarseerSimulator *simulator, FarseerBody body, float *mass);

// Sets the mass in mass units, not 0.
FarseerStatus farseer_body_set_mass(const FarseerSimulator *simulator, FarseerBody body, float mass);

// Writes the moment of inertia in mass units · length units², > 0.
FarseerStatus farseer_body_moment_of_inertia(const FarseerSimulator *simulator,
                                             FarseerBody body,
                                             float *moment_of_inertia);

// Sets the moment of inertia in mass units · length units², > 0.
FarseerStatus farseer_body_set_moment_of_inertia(const FarseerSimulator *simulator,
                                                 FarseerBody body,
                                                 float moment_of_inertia);

// Writes the coefficient of linear drag in mass units/s: force = -c · velocity. Default 0.001.
FarseerStatus farseer_body_linear_drag_coefficient(const FarseerSimulator *simulator,
                                                   FarseerBody body,
                                                   float *linear_drag_coefficient);

// Sets the coefficient of linear drag in mass units/s: force = -c · velocity. Default 0.001.
FarseerStatus farseer_body_set_linear_drag_coefficient(const FarseerSimulator *simulator,
                                                       FarseerBody body,
                                                       float linear_drag_coefficient);

// Writes the coefficient of rotational drag: torque = -c · angular velocity · |angular velocity|. Default 0.001.
FarseerStatus farseer_body_rotational_drag_coefficient(const FarseerSimulator *simulator,
                                                       FarseerBody body,
                                                       float *rotational_drag_coefficient);

// Sets the coefficient of rotational drag: torque = -c · angular velocity · |angular velocity|. Default 0.001.
FarseerStatus farseer_body_set_rotational_drag_coefficient(const FarseerSimulator *simulator,
                                                           FarseerBody body,
                                                           float rotational_drag_coefficient);

// Writes the factor by which gravity acts on the body. Default 1.
FarseerStatus farseer_body_gravity_scale(const FarseerSimulator *simulator, FarseerBody body, float *gravity_scale);

// Sets the factor by which gravity acts on the body. Default 1.
FarseerStatus farseer_body_set_gravity_scale(const FarseerSimulator *simulator, FarseerBody body, float gravity_scale);

// Writes whether gravity has no effect on the body: 0 or 1.
FarseerStatus farseer_body_ignore_gravity(const FarseerSimulator *simulator, FarseerBody body, int32_t *ignore_gravity);

// Sets whether gravity has no effect on the body: 0 or 1.
FarseerStatus farseer_body_set_ignore_gravity(const FarseerSimulator *simulator,
                                              FarseerBody body,
                                              int32_t ignore_gravity);

// Writes whether the body never moves: 0 or 1.
FarseerStatus farseer_body_is_static(const FarseerSimulator *simulator, FarseerBody body, int32_t *is_static);

// Sets whether the body never moves: 0 or 1.
FarseerStatus farseer_body_set_is_static(const FarseerSimulator *simulator, FarseerBody body, int32_t is_static);

// Writes whether only its velocity moves the body: 0 or 1.
FarseerStatus farseer_body_is_kinematic(const FarseerSimulator *simulator, FarseerBody body, int32_t *is_kinematic);

// Sets whether only its velocity moves the body: 0 or 1.
FarseerStatus farseer_body_set_is_kinematic(const FarseerSimulator *simulator, FarseerBody body, int32_t is_kinematic);

// Writes whether continuous collision acts against all bodies: 0 or 1.
FarseerStatus farseer_body_is_bullet(const FarseerSimulator *simulator, FarseerBody body, int32_t *is_bullet);

// Sets whether continuous collision acts against all bodies: 0 or 1.
FarseerStatus farseer_body_set_is_bullet(const FarseerSimulator *simulator, FarseerBody body, int32_t is_bullet);

// Writes whether the body takes part: 0 or 1. Default 1.
FarseerStatus farseer_body_enabled(const FarseerSimulator *simulator, FarseerBody body, int32_t *enabled);

// Sets whether the body takes part: 0 or 1. Default 1.
FarseerStatus farseer_body_set_enabled(const FarseerSimulator *simulator, FarseerBody body, int32_t enabled);

// Writes whether the body never turns: 0 or 1.
FarseerStatus farseer_body_rotation_locked(const FarseerSimulator *simulator,
                                           FarseerBody body,
                                           int32_t *rotation_locked);

// Sets whether the body never turns: 0 or 1.
FarseerStatus farseer_body_set_rotation_locked(const FarseerSimulator *simulator,
                                               FarseerBody body,
                                               int32_t rotation_locked);

// Writes whether the body may fall asleep: 0 or 1. Default 1.
FarseerStatus farseer_body_sleep_allowed(const FarseerSimulator *simulator, FarseerBody body, int32_t *sleep_allowed);

// Sets whether the body may fall asleep: 0 or 1. Default 1.
FarseerStatus farseer_body_set_sleep_allowed(const FarseerSimulator *simulator,
                                             FarseerBody body,
                                             int32_t sleep_allowed);

// Writes whether sleep and waking of the body are events: 0 or 1.
FarseerStatus farseer_body_sleep_events(const FarseerSimulator *simulator, FarseerBody body, int32_t *sleep_events);

// Sets whether sleep and waking of the body are events: 0 or 1.
FarseerStatus farseer_body_set_sleep_events(const FarseerSimulator *simulator, FarseerBody body, int32_t sleep_events);

// Writes a number of yours, which the engine never reads.
FarseerStatus farseer_body_tag(const FarseerSimulator *simulator, FarseerBody body, uint64_t *tag);

// Sets a number of yours, which the engine never reads.
FarseerStatus farseer_body_set_tag(const FarseerSimulator *simulator, FarseerBody body, uint64_t tag);

// Writes the position in the world of a point of the body, both in length units.
FarseerStatus farseer_body_world_position(const FarseerSimulator *simulator,
                                          FarseerBody body,
                                          FarseerVector2 local,
                                          FarseerVector2 *world);

// Writes the position on the body of a point of the world, both in length units.
FarseerStatus farseer_body_local_position(const FarseerSimulator *simulator,
                                          FarseerBody body,
                                          FarseerVector2 world,
                                          FarseerVector2 *local);

// Makes a body with the moment of inertia of a rectangle; sides in length units, > 0.
// It has no shape: add a geom.
FarseerStatus farseer_body_create_rectangle(const FarseerSimulator *simulator,
                                            float width,
                                            float height,
                                            float mass,
                                            FarseerBody *body);

// Makes a body with the moment of inertia of a disc; radius in length units, > 0.
// It has no shape: add a geom.
FarseerStatus farseer_body_create_circle(const FarseerSimulator *simulator,
                                         float radius,
                                         float mass,
                                         FarseerBody *body);

// Makes a body with the moment of inertia of an ellipse; radii in length units, > 0.
// It has no shape: add a geom.
FarseerStatus farseer_body_create_ellipse(const FarseerSimulator *simulator,
                                          float x_radius,
                                          float y_radius,
                                          float mass,
                                          FarseerBody *body);

// Makes a body with the moment of inertia of an upright capsule; height from tip to tip and radius in length units.
// It has no shape: add a geom.
FarseerStatus farseer_body_create_capsule(const FarseerSimulator *simulator,
                                          float height,
                                          float end_radius,
                                          float mass,
                                          FarseerBody *body);

// Makes a body with this mass in mass units and moment of inertia in mass units · length units².
// It has no shape: add a geom.
FarseerStatus farseer_body_create_with_inertia(const FarseerSimulator *simulator,
                                               float mass,
                                               float moment_of_inertia,
                                               FarseerBody *body);

// Makes a body with the moment of inertia of a polygon; corners in length units.
// It has no shape: add a geom.
//
// # Safety
// An array that is not null has the items that its number says.
FarseerStatus farseer_body_create_polygon(const FarseerSimulator *simulator,
                                          const FarseerVector2 *points,
                                          size_t count,
                                          float mass,
                                          FarseerBody *body);

// Adds a force in mass units · length units/s² that acts at the origin in the next update.
FarseerStatus farseer_body_apply_force(const FarseerSimulator *simulator, FarseerBody body, FarseerVector2 force);

// Adds a force in mass units · length units/s² that acts at a point of the world in the next update.
FarseerStatus farseer_body_apply_force_at_world_point(const FarseerSimulator *simulator,
                                                      FarseerBody body,
                                                      FarseerVector2 force,
                                                      FarseerVector2 point);

// Adds a torque in mass units · length units²/s² that acts in the next update.
FarseerStatus farseer_body_apply_torque(const FarseerSimulator *simulator, FarseerBody body, float torque);

// Adds an impulse at the origin in mass units · length units/s.
FarseerStatus farseer_body_apply_impulse(const FarseerSimulator *simulator, FarseerBody body, FarseerVector2 impulse);

// Adds an impulse at a point of the world in mass units · length units/s.
FarseerStatus farseer_body_apply_impulse_at_world_point(const FarseerSimulator *simulator,
                                                        FarseerBody body,
                                                        FarseerVector2 impulse,
                                                        FarseerVector2 point);

// Adds an angular impulse in mass units · length units²/s.
FarseerStatus farseer_body_apply_angular_impulse(const FarseerSimulator *simulator, FarseerBody body, float impulse);

// Removes the forces, torques and impulses that wait for the next update.
FarseerStatus farseer_body_clear_forces(const FarseerSimulator *simulator, FarseerBody body);

// Puts the body at the origin, at rest and without rotation, and removes the forces that wait, as Farseer's ResetDynamics.
FarseerStatus farseer_body_reset_dynamics(const FarseerSimulator *simulator,
                                          FarseerBody body);

// Moves a kinematic body to a position in length units and a rotation in radians in the next update.
FarseerStatus farseer_body_move_to(const FarseerSimulator *simulator,
                                   FarseerBody body,
                                   FarseerVector2 position,
                                   float rotation);

// Puts a body to sleep at the end of the next update, with all bodies that touch it, under the precise methods.
FarseerStatus farseer_body_sleep(const FarseerSimulator *simulator, FarseerBody body);

// Wakes a body in the next update.
FarseerStatus farseer_body_wake(const FarseerSimulator *simulator, FarseerBody body);

// Writes whether a body sleeps: 0 or 1.
FarseerStatus farseer_body_is_asleep(const FarseerSimulator *simulator, FarseerBody body, int32_t *is_asleep);

// Writes the options of a dynamic body at the origin.
FarseerStatus farseer_body_options_default(FarseerBodyOptions *options);

// Adds a body with `count` geoms, whose mass and centre of mass become those of the body. Writes its id, and the ids of the geoms to
// `ids`, an array of that length, which may be null.
//
// # Safety
// An array that is not null has the items that its number says.
FarseerStatus farseer_body_create(const FarseerSimulator *simulator,
                                  const FarseerBodyOptions *options,
                                  const FarseerGeomOptions *geoms,
                                  size_t count,
                                  FarseerBody *body,
                                  FarseerGeom *ids);

// Sets mass and moment of inertia of a body from its geoms, with one density in mass units/length unit².
FarseerStatus farseer_body_set_density(const FarseerSimulator *simulator, FarseerBody body, float density);

// Reads `count` bodies into arrays of that length: positions in length units, rotations in radians, velocities in length units/s,
// angular velocities in rad/s. An array that is not wanted is null. No array is written if one id is stale.
//
// # Safety
// An array that is not null has the items that its number says.
FarseerStatus farseer_bodies_read(const FarseerSimulator *simulator,
                                  const FarseerBody *bodies,
                                  size_t count,
                                  FarseerVector2 *positions,
                                  float *rotations,
                                  FarseerVector2 *linear_velocities,
                                  float *angular_velocities);

// Writes the events of the last update, in their order, and their number. The next update replaces them.
//
// # Safety
// An array that is not null has the items that its number says.
FarseerStatus farseer_simulator_events(const FarseerSimulator *simulator,
                                       FarseerEvent *events,
                                       size_t capacity,
                                       size_t *count);

// Writes the hits of the last update under the precise methods, and their number. Geoms have to want them.
//
// # Safety
// An array that is not null has the items that its number says.
FarseerStatus farseer_simulator_hits(const FarseerSimulator *simulator,
                                     FarseerHit *hits,
                                     size_t capacity,
                                     size_t *count);

// Writes the contacts of a body after the last update, and their number.
//
// # Safety
// An array that is not null has the items that its number says.
FarseerStatus farseer_body_contacts(const FarseerSimulator *simulator,
                                    FarseerBody body,
                                    FarseerBodyContact *contacts,
                                    size_t capacity,
                                    size_t *count);

// The message of the last refused call of this thread, in UTF-8; empty before the first. Valid until the next refused call of
// this thread. It names the argument and its value.
const char *farseer_last_error(void);

// The version of the library, such as "0.2.0".
const char *farseer_version(void);

// Writes the friction coefficient. Default 0 for geoms of the factories.
FarseerStatus farseer_geom_friction_coefficient(const FarseerSimulator *simulator,
                                                FarseerGeom geom,
                                                float *friction_coefficient);

// Sets the friction coefficient. Default 0 for geoms of the factories.
FarseerStatus farseer_geom_set_friction_coefficient(const FarseerSimulator *simulator,
                                                    FarseerGeom geom,
                                                    float friction_coefficient);

// Writes the restitution coefficient, 0 to 1. Default 0.
FarseerStatus farseer_geom_restitution_coefficient(const FarseerSimulator *simulator,
                                                   FarseerGeom geom,
                                                   float *restitution_coefficient);

// Sets the restitution coefficient, 0 to 1. Default 0.
FarseerStatus farseer_geom_set_restitution_coefficient(const FarseerSimulator *simulator,
                                                       FarseerGeom geom,
                                                       float restitution_coefficient);

// Writes the categories of the geom, one bit each. Default 0x7fffffff, all.
FarseerStatus farseer_geom_collision_categories(const FarseerSimulator *simulator,
                                                FarseerGeom geom,
                                                int32_t *collision_categories);

// Sets the categories of the geom, one bit each. Default 0x7fffffff, all.
FarseerStatus farseer_geom_set_collision_categories(const FarseerSimulator *simulator,
                                                    FarseerGeom geom,
                                                    int32_t collision_categories);

// Writes the categories that the geom collides with, one bit each. Default 0x7fffffff, all.
FarseerStatus farseer_geom_collides_with(const FarseerSimulator *simulator, FarseerGeom geom, int32_t *collides_with);

// Sets the categories that the geom collides with, one bit each. Default 0x7fffffff, all.
FarseerStatus farseer_geom_set_collides_with(const FarseerSimulator *simulator,
                                             FarseerGeom geom,
                                             int32_t collides_with);

// Writes the group: geoms of one group other than 0 do not collide.
FarseerStatus farseer_geom_collision_group(const FarseerSimulator *simulator,
                                           FarseerGeom geom,
                                           int32_t *collision_group);

// Sets the group: geoms of one group other than 0 do not collide.
FarseerStatus farseer_geom_set_collision_group(const FarseerSimulator *simulator,
                                               FarseerGeom geom,
                                               int32_t collision_group);

// Writes whether the geom collides: 0 or 1. Default 1.
FarseerStatus farseer_geom_collision_enabled(const FarseerSimulator *simulator,
                                             FarseerGeom geom,
                                             int32_t *collision_enabled);

// Sets whether the geom collides: 0 or 1. Default 1.
FarseerStatus farseer_geom_set_collision_enabled(const FarseerSimulator *simulator,
                                                 FarseerGeom geom,
                                                 int32_t collision_enabled);

// Writes whether contacts of the geom exert impulses: 0 or 1. Default 1.
FarseerStatus farseer_geom_collision_response_enabled(const FarseerSimulator *simulator,
                                                      FarseerGeom geom,
                                                      int32_t *collision_response_enabled);

// Sets whether contacts of the geom exert impulses: 0 or 1. Default 1.
FarseerStatus farseer_geom_set_collision_response_enabled(const FarseerSimulator *simulator,
                                                          FarseerGeom geom,
                                                          int32_t collision_response_enabled);

// Writes a number of yours, which the engine never reads.
FarseerStatus farseer_geom_tag(const FarseerSimulator *simulator, FarseerGeom geom, uint64_t *tag);

// Sets a number of yours, which the engine never reads.
FarseerStatus farseer_geom_set_tag(const FarseerSimulator *simulator, FarseerGeom geom, uint64_t tag);

// Makes a geom a sensor, which exerts no impulses, or an ordinary geom: 1 or 0.
FarseerStatus farseer_geom_set_sensor(const FarseerSimulator *simulator, FarseerGeom geom, int32_t sensor);

// Sets which events the geom wants under the precise methods: a sum of FarseerWantedEvents.
FarseerStatus farseer_geom_set_wanted_events(const FarseerSimulator *simulator,
                                             FarseerGeom geom,
                                             int32_t wanted_events);

// Makes a geom solid from one side alone, under the precise methods. `direction` points out of the solid side, in the body's frame;
// (0, 0) makes it solid from all sides.
FarseerStatus farseer_geom_set_one_way(const FarseerSimulator *simulator,
                                       FarseerGeom geom,
                                       FarseerVector2 direction);

// Lets two geoms pass through each other, until farseer_geom_restore_collision_with.
FarseerStatus farseer_geom_ignore_collision_with(const FarseerSimulator *simulator,
                                                 FarseerGeom geom,
                                                 FarseerGeom other);

// Ends farseer_geom_ignore_collision_with.
FarseerStatus farseer_geom_restore_collision_with(const FarseerSimulator *simulator,
                                                  FarseerGeom geom,
                                                  FarseerGeom other);

// Writes the body of a geom.
FarseerStatus farseer_geom_body(const FarseerSimulator *simulator, FarseerGeom geom, FarseerBody *body);

// Adds a rectangle to a body; sides in length units, > 0.
// `placement` may be null.
FarseerStatus farseer_geom_create_rectangle(const FarseerSimulator *simulator,
                                            FarseerBody body,
                                            float width,
                                            float height,
                                            const FarseerPlacement *placement,
                                            FarseerGeom *geom);

// Adds a circle to a body; radius in length units, > 0. For the faithful methods it is a polygon with this number of edges.
// `placement` may be null.
FarseerStatus farseer_geom_create_circle(const FarseerSimulator *simulator,
                                         FarseerBody body,
                                         float radius,
                                         int32_t edges,
                                         const FarseerPlacement *placement,
                                         FarseerGeom *geom);

// Adds an ellipse as a polygon to a body; radii in length units, > 0.
// `placement` may be null.
FarseerStatus farseer_geom_create_ellipse(const FarseerSimulator *simulator,
                                          FarseerBody body,
                                          float x_radius,
                                          float y_radius,
                                          int32_t edges,
                                          const FarseerPlacement *placement,
                                          FarseerGeom *geom);

// Adds an upright capsule to a body; height from tip to tip and radius in length units, with this number of edges at each end.
// `placement` may be null.
FarseerStatus farseer_geom_create_capsule(const FarseerSimulator *simulator,
                                          FarseerBody body,
                                          float height,
                                          float end_radius,
                                          int32_t edges,
                                          const FarseerPlacement *placement,
                                          FarseerGeom *geom);

// Adds a polygon to a body; corners in length units.
// `placement` may be null.
//
// # Safety
// An array that is not null has the items that its number says.
FarseerStatus farseer_geom_create_polygon(const FarseerSimulator *simulator,
                                          FarseerBody body,
                                          const FarseerVector2 *points,
                                          size_t count,
                                          const FarseerPlacement *placement,
                                          FarseerGeom *geom);

// Writes the options of a rectangle of 1 by 1 length unit, with friction 0.6.
FarseerStatus farseer_geom_options_default(FarseerGeomOptions *options);

// Adds a geom to a body, whose mass and centre of mass stay.
//
// # Safety
// An array that is not null has the items that its number says.
FarseerStatus farseer_geom_create(const FarseerSimulator *simulator,
                                  FarseerBody body,
                                  const FarseerGeomOptions *options,
                                  FarseerGeom *geom);

// Writes whether the joint acts: 0 or 1. A joint that broke is disabled.
FarseerStatus farseer_joint_enabled(const FarseerSimulator *simulator, FarseerJoint joint, int32_t *enabled);

// Sets whether the joint acts: 0 or 1. A joint that broke is disabled.
FarseerStatus farseer_joint_set_enabled(const FarseerSimulator *simulator, FarseerJoint joint, int32_t enabled);

// Writes the fraction of the error that an update corrects. Default 0.2, for fixed revolute joints 0.8.
FarseerStatus farseer_joint_bias_factor(const FarseerSimulator *simulator, FarseerJoint joint, float *bias_factor);

// Sets the fraction of the error that an update corrects. Default 0.2, for fixed revolute joints 0.8.
FarseerStatus farseer_joint_set_bias_factor(const FarseerSimulator *simulator, FarseerJoint joint, float bias_factor);

// Writes how far the joint yields to its load; the unit depends on the kind. Default 0.
FarseerStatus farseer_joint_softness(const FarseerSimulator *simulator, FarseerJoint joint, float *softness);

// Sets how far the joint yields to its load; the unit depends on the kind. Default 0.
FarseerStatus farseer_joint_set_softness(const FarseerSimulator *simulator, FarseerJoint joint, float softness);

// Writes the error, in length units or radians, beyond which the joint breaks.
FarseerStatus farseer_joint_breakpoint(const FarseerSimulator *simulator, FarseerJoint joint, float *breakpoint);

// Sets the error, in length units or radians, beyond which the joint breaks.
FarseerStatus farseer_joint_set_breakpoint(const FarseerSimulator *simulator, FarseerJoint joint, float breakpoint);

// Writes the force, in mass units · length units/s², beyond which the joint breaks under the precise methods.
FarseerStatus farseer_joint_greatest_force(const FarseerSimulator *simulator,
                                           FarseerJoint joint,
                                           float *greatest_force);

// Sets the force, in mass units · length units/s², beyond which the joint breaks under the precise methods.
FarseerStatus farseer_joint_set_greatest_force(const FarseerSimulator *simulator,
                                               FarseerJoint joint,
                                               float greatest_force);

// Writes the torque, in mass units · length units²/s², beyond which the joint breaks under the precise methods.
FarseerStatus farseer_joint_greatest_torque(const FarseerSimulator *simulator,
                                            FarseerJoint joint,
                                            float *greatest_torque);

// Sets the torque, in mass units · length units²/s², beyond which the joint breaks under the precise methods.
FarseerStatus farseer_joint_set_greatest_torque(const FarseerSimulator *simulator,
                                                FarseerJoint joint,
                                                float greatest_torque);

// Writes the force of the joint in the last update, in mass units · length units/s², under the precise methods.
FarseerStatus farseer_joint_force(const FarseerSimulator *simulator, FarseerJoint joint, FarseerVector2 *force);

// Writes the torque of the joint in the last update, in mass units · length units²/s², under the precise methods.
FarseerStatus farseer_joint_torque(const FarseerSimulator *simulator, FarseerJoint joint, float *torque);

// Writes the error of the joint in the last update, in length units or radians.
FarseerStatus farseer_joint_error(const FarseerSimulator *simulator, FarseerJoint joint, float *error);

// Writes a number of yours, which the engine never reads.
FarseerStatus farseer_joint_tag(const FarseerSimulator *simulator, FarseerJoint joint, uint64_t *tag);

// Sets a number of yours, which the engine never reads.
FarseerStatus farseer_joint_set_tag(const FarseerSimulator *simulator, FarseerJoint joint, uint64_t tag);

// Writes the kind of a joint: a FarseerJointKind.
FarseerStatus farseer_joint_kind(const FarseerSimulator *simulator, FarseerJoint joint, int32_t *kind);

// Sets whether the two bodies collide: 0 or 1. Default 1; 0 needs the precise methods.
FarseerStatus farseer_joint_set_bodies_collide(const FarseerSimulator *simulator,
                                               FarseerJoint joint,
                                               int32_t bodies_collide);

// Two bodies keep a common point of the world, in length units: a hinge.
FarseerStatus farseer_joint_create_revolute(const FarseerSimulator *simulator,
                                            FarseerBody body1,
                                            FarseerBody body2,
                                            FarseerVector2 anchor,
                                            FarseerJoint *joint);

// A point of a body stays at a point of the world, in length units: a hinge.
FarseerStatus farseer_joint_create_fixed_revolute(const FarseerSimulator *simulator,
                                                  FarseerBody body,
                                                  FarseerVector2 anchor,
                                                  FarseerJoint *joint);

// Two points keep their distance: a rod. Anchors are in the frames of the bodies, in length units.
FarseerStatus farseer_joint_create_pin(const FarseerSimulator *simulator,
                                       FarseerBody body1,
                                       FarseerVector2 anchor1,
                                       FarseerBody body2,
                                       FarseerVector2 anchor2,
                                       FarseerJoint *joint);

// The distance of two points stays in a range: a rope, a telescope. Anchors are in the frames of the bodies, all in length
// units.
FarseerStatus farseer_joint_create_slider(const FarseerSimulator *simulator,
                                          FarseerBody body1,
                                          FarseerVector2 anchor1,
                                          FarseerBody body2,
                                          FarseerVector2 anchor2,
                                          float min,
                                          float max,
                                          FarseerJoint *joint);

// Two bodies keep a relative angle.
FarseerStatus farseer_joint_create_angle(const FarseerSimulator *simulator,
                                         FarseerBody body1,
                                         FarseerBody body2,
                                         FarseerJoint *joint);

// A body keeps its angle.
FarseerStatus farseer_joint_create_fixed_angle(const FarseerSimulator *simulator,
                                               FarseerBody body,
                                               FarseerJoint *joint);

// The relative angle of two bodies stays in a range, in radians.
FarseerStatus farseer_joint_create_angle_limit(const FarseerSimulator *simulator,
                                               FarseerBody body1,
                                               FarseerBody body2,
                                               float min,
                                               float max,
                                               FarseerJoint *joint);

// The angle of a body stays in a range, in radians.
FarseerStatus farseer_joint_create_fixed_angle_limit(const FarseerSimulator *simulator,
                                                     FarseerBody body,
                                                     float min,
                                                     float max,
                                                     FarseerJoint *joint);

// Two bodies keep a common point of the world, in length units, and their relative angle.
FarseerStatus farseer_joint_create_weld(const FarseerSimulator *simulator,
                                        FarseerBody body1,
                                        FarseerBody body2,
                                        FarseerVector2 anchor,
                                        FarseerJoint *joint);

// The second body slides along a line of the first: a piston. Anchor and axis are in the world, in length units. Under the precise
// methods.
FarseerStatus farseer_joint_create_prismatic(const FarseerSimulator *simulator,
                                             FarseerBody body1,
                                             FarseerBody body2,
                                             FarseerVector2 anchor,
                                             FarseerVector2 axis,
                                             FarseerJoint *joint);

// The second body turns about a point on a sprung line of the first: a wheel with suspension. Anchor and axis are in the world,
// in length units; stiffness in mass units/s², damping in mass units/s. Under the precise methods.
FarseerStatus farseer_joint_create_wheel(const FarseerSimulator *simulator,
                                         FarseerBody body1,
                                         FarseerBody body2,
                                         FarseerVector2 anchor,
                                         FarseerVector2 axis,
                                         float stiffness,
                                         float damping,
                                         FarseerJoint *joint);

// A damped spring turns two bodies to their present relative angle: stiffness in torque per radian, damping in torque per rad/s.
// Under the precise methods.
FarseerStatus farseer_joint_create_angle_spring(const FarseerSimulator *simulator,
                                                FarseerBody body1,
                                                FarseerBody body2,
                                                float stiffness,
                                                float damping,
                                                FarseerJoint *joint);

// A bounded force and torque bring the second body to a pose relative to the first: frequency in Hz, damping ratio, greatest
// force and torque. Under the precise methods.
FarseerStatus farseer_joint_create_motor(const FarseerSimulator *simulator,
                                         FarseerBody body1,
                                         FarseerBody body2,
                                         float frequency,
                                         float damping_ratio,
                                         float greatest_force,
                                         float greatest_torque,
                                         FarseerJoint *joint);

// Two bodies turn in a ratio. Under the precise methods.
FarseerStatus farseer_joint_create_gear(const FarseerSimulator *simulator,
                                        FarseerBody body1,
                                        FarseerBody body2,
                                        float ratio,
                                        FarseerJoint *joint);

// A rope from the first body over two points of the world to the second, in length units, with a ratio of the two parts. Anchors
// are in the frames of the bodies. Under the precise methods.
FarseerStatus farseer_joint_create_pulley(const FarseerSimulator *simulator,
                                          FarseerBody body1,
                                          FarseerVector2 anchor1,
                                          FarseerVector2 pulley1,
                                          FarseerBody body2,
                                          FarseerVector2 anchor2,
                                          FarseerVector2 pulley2,
                                          float ratio,
                                          FarseerJoint *joint);

// Drives a joint, under the precise methods: speed in rad/s or length units/s, greatest torque or force in mass units · length
// units²/s² or mass units · length units/s².
FarseerStatus farseer_joint_set_motor(const FarseerSimulator *simulator,
                                      FarseerJoint joint,
                                      float speed,
                                      float greatest_effort);

// Drives a joint no longer.
FarseerStatus farseer_joint_remove_motor(const FarseerSimulator *simulator, FarseerJoint joint);

// Bounds the travel of a joint, in radians or length units, under the precise methods.
FarseerStatus farseer_joint_set_limits(const FarseerSimulator *simulator, FarseerJoint joint, float lower, float upper);

// Bounds the travel of a joint no longer.
FarseerStatus farseer_joint_remove_limits(const FarseerSimulator *simulator, FarseerJoint joint);

// Lets a joint seek a position in radians or length units, under the precise methods. Stiffness and damping are torque per
// radian and per rad/s, or force per length unit and per length unit/s.
FarseerStatus farseer_joint_set_servo(const FarseerSimulator *simulator,
                                      FarseerJoint joint,
                                      float target,
                                      float stiffness,
                                      float damping,
                                      float greatest_effort);

// Lets a joint seek no position.
FarseerStatus farseer_joint_remove_servo(const FarseerSimulator *simulator, FarseerJoint joint);

// Sets the range of a slider joint in length units, or of an angle limit joint in radians.
FarseerStatus farseer_joint_set_range(const FarseerSimulator *simulator, FarseerJoint joint, float lower, float upper);

// Sets the distance of a pin joint in length units, or the angle of an angle joint in radians.
FarseerStatus farseer_joint_set_target(const FarseerSimulator *simulator, FarseerJoint joint, float target);

// Sets the pose of the second body of a motor joint relative to the first: offset in length units, angle in radians.
FarseerStatus farseer_joint_set_motor_target(const FarseerSimulator *simulator,
                                             FarseerJoint joint,
                                             FarseerVector2 offset,
                                             float angle);

// Writes how far a joint has turned in radians, or slid in length units.
FarseerStatus farseer_joint_travel(const FarseerSimulator *simulator, FarseerJoint joint, float *travel);

// Disposes a body, geom, joint or spring: with the next update it leaves, and its id goes stale. The geoms of a body go with it,
// and the joints and springs between it and other bodies.
FarseerStatus farseer_object_dispose(const FarseerSimulator *simulator,
                                     FarseerId number);

// Takes an object out of the simulation with the next update, without disposing it.
FarseerStatus farseer_object_remove(const FarseerSimulator *simulator, FarseerId number);

// Adds an object that was removed, with the next update.
FarseerStatus farseer_object_add(const FarseerSimulator *simulator, FarseerId number);

// Writes whether an object was disposed: 0 or 1; 1 for every stale id.
FarseerStatus farseer_object_is_disposed(const FarseerSimulator *simulator, FarseerId number, int32_t *is_disposed);

// Writes the ids of the bodies that take part, in the order of their list, and their number. Objects enter with the next update.
//
// # Safety
// An array that is not null has the items that its number says.
FarseerStatus farseer_simulator_bodies(const FarseerSimulator *simulator,
                                       FarseerBody *bodies,
                                       size_t capacity,
                                       size_t *count);

// Writes the ids of the geoms that take part, in the order of their list, and their number. Objects enter with the next update.
//
// # Safety
// An array that is not null has the items that its number says.
FarseerStatus farseer_simulator_geoms(const FarseerSimulator *simulator,
                                      FarseerGeom *geoms,
                                      size_t capacity,
                                      size_t *count);

// Writes the ids of the joints that take part, in the order of their list, and their number. Objects enter with the next update.
//
// # Safety
// An array that is not null has the items that its number says.
FarseerStatus farseer_simulator_joints(const FarseerSimulator *simulator,
                                       FarseerJoint *joints,
                                       size_t capacity,
                                       size_t *count);

// Writes the ids of the springs that take part, in the order of their list, and their number. Objects enter with the next update.
//
// # Safety
// An array that is not null has the items that its number says.
FarseerStatus farseer_simulator_springs(const FarseerSimulator *simulator,
                                        FarseerSpring *springs,
                                        size_t capacity,
                                        size_t *count);

// Writes the ids of the geoms of a body, and their number.
//
// # Safety
// An array that is not null has the items that its number says.
FarseerStatus farseer_body_geoms(const FarseerSimulator *simulator,
                                 FarseerBody body,
                                 FarseerGeom *geoms,
                                 size_t capacity,
                                 size_t *count);

// Writes the first geom that a ray between two points enters, in length units, and whether there is one: 0 or 1. Without one, the hit
// is zero. `filter` may be null.
FarseerStatus farseer_simulator_cast_ray(const FarseerSimulator *simulator,
                                         FarseerVector2 start,
                                         FarseerVector2 end,
                                         const FarseerQueryFilter *filter,
                                         FarseerRayHit *hit,
                                         int32_t *found);

// Writes all geoms that a ray between two points enters, by distance, and their number. `filter` may be null.
//
// # Safety
// An array that is not null has the items that its number says.
FarseerStatus farseer_simulator_cast_ray_all(const FarseerSimulator *simulator,
                                             FarseerVector2 start,
                                             FarseerVector2 end,
                                             const FarseerQueryFilter *filter,
                                             FarseerRayHit *hits,
                                             size_t capacity,
                                             size_t *count);

// Writes the geoms that contain a point, and their number. `filter` may be null.
//
// # Safety
// An array that is not null has the items that its number says.
FarseerStatus farseer_simulator_geoms_at(const FarseerSimulator *simulator,
                                         FarseerVector2 point,
                                         const FarseerQueryFilter *filter,
                                         FarseerGeom *geoms,
                                         size_t capacity,
                                         size_t *count);

// Writes the geoms whose boxes overlap the box from `min` to `max`, in length units, and their number.
//
// # Safety
// An array that is not null has the items that its number says.
FarseerStatus farseer_simulator_geoms_in_box(const FarseerSimulator *simulator,
                                             FarseerVector2 min,
                                             FarseerVector2 max,
                                             FarseerGeom *geoms,
                                             size_t capacity,
                                             size_t *count);

// Writes the filter that finds all geoms but sensors.
FarseerStatus farseer_query_filter_default(FarseerQueryFilter *filter);

// Writes the gravity in length units/s².
FarseerStatus farseer_simulator_gravity(const FarseerSimulator *simulator, FarseerVector2 *gravity);

// Sets the gravity in length units/s², y down.
FarseerStatus farseer_simulator_set_gravity(const FarseerSimulator *simulator, FarseerVector2 gravity);

// Writes whether updates move bodies: 0 or 1.
FarseerStatus farseer_simulator_enabled(const FarseerSimulator *simulator, int32_t *enabled);

// Sets whether updates move bodies: 0 or 1.
FarseerStatus farseer_simulator_set_enabled(const FarseerSimulator *simulator, int32_t enabled);

// Writes the number of iterations, or of substeps of the precise methods.
FarseerStatus farseer_simulator_iterations(const FarseerSimulator *simulator, int32_t *iterations);

// Sets the number of iterations, or of substeps of the precise methods. 5 for faithful, 4 for precise simulators.
FarseerStatus farseer_simulator_set_iterations(const FarseerSimulator *simulator, int32_t iterations);

// Writes the fraction of the penetration that an update corrects.
FarseerStatus farseer_simulator_bias_factor(const FarseerSimulator *simulator, float *bias_factor);

// Sets the fraction of the penetration that an update corrects. Default 0.8.
FarseerStatus farseer_simulator_set_bias_factor(const FarseerSimulator *simulator, float bias_factor);

// Writes the penetration in length units that is not corrected.
FarseerStatus farseer_simulator_allowed_penetration(const FarseerSimulator *simulator, float *allowed_penetration);

// Sets the penetration in length units that is not corrected. Default 0.05.
FarseerStatus farseer_simulator_set_allowed_penetration(const FarseerSimulator *simulator, float allowed_penetration);

// Writes the maximum number of contacts of a pair that are found.
FarseerStatus farseer_simulator_max_contacts_to_detect(const FarseerSimulator *simulator,
                                                       int32_t *max_contacts_to_detect);

// Sets the maximum number of contacts of a pair that are found. Default 10.
FarseerStatus farseer_simulator_set_max_contacts_to_detect(const FarseerSimulator *simulator,
                                                           int32_t max_contacts_to_detect);

// Writes the maximum number of contacts of a pair that are solved.
FarseerStatus farseer_simulator_max_contacts_to_resolve(const FarseerSimulator *simulator,
                                                        int32_t *max_contacts_to_resolve);

// Sets the maximum number of contacts of a pair that are solved. Default 4.
FarseerStatus farseer_simulator_set_max_contacts_to_resolve(const FarseerSimulator *simulator,
                                                            int32_t max_contacts_to_resolve);

// Writes whether bodies at rest fall asleep: 0 or 1.
FarseerStatus farseer_simulator_sleep_enabled(const FarseerSimulator *simulator, int32_t *sleep_enabled);

// Sets whether bodies at rest fall asleep under the precise methods: 0 or 1.
FarseerStatus farseer_simulator_set_sleep_enabled(const FarseerSimulator *simulator, int32_t sleep_enabled);

// Sets how the coefficients of two geoms become one: a FarseerFriction.
FarseerStatus farseer_simulator_set_friction_type(const FarseerSimulator *simulator, int32_t friction_type);

// Sets the broad phase of the faithful methods: a FarseerBroadPhase. Refused once there are geoms.
FarseerStatus farseer_simulator_set_broad_phase(const FarseerSimulator *simulator, int32_t broad_phase);

// Sets the narrow phase of the faithful methods: a FarseerNarrowPhase. Set it before geoms are made.
FarseerStatus farseer_simulator_set_narrow_phase(const FarseerSimulator *simulator, int32_t narrow_phase);

// Sets the size of the objects that a player looks at, in length units, under the precise methods: 32 for games in px, 1 for
// games in metres. Default 32.
FarseerStatus farseer_simulator_set_length_unit(const FarseerSimulator *simulator,
                                                float length_unit);

// Bounds the speed of bodies under the precise methods, in length units/s, > 0.
FarseerStatus farseer_simulator_set_largest_speed(const FarseerSimulator *simulator, float largest_speed);

// Sets the speed in length units/s from which on a touch is a hit under the precise methods.
FarseerStatus farseer_simulator_set_hit_speed(const FarseerSimulator *simulator, float hit_speed);

// Makes a simulator with methods, a FarseerMethods, and gravity in length units/s², y down. Null if refused:
// farseer_last_error says why. End it with farseer_simulator_destroy.
FarseerSimulator *farseer_simulator_create(int32_t methods, FarseerVector2 gravity);

// Frees a simulator; null is ignored. No other call may use it, now or later.
void farseer_simulator_destroy(FarseerSimulator *simulator);

// Advances the simulation by `dt` s. With 0, objects only enter and leave.
FarseerStatus farseer_simulator_update(const FarseerSimulator *simulator, float dt);

// Removes all objects; all ids go stale.
FarseerStatus farseer_simulator_clear(const FarseerSimulator *simulator);

// Writes the methods: a FarseerMethods.
FarseerStatus farseer_simulator_methods(const FarseerSimulator *simulator, int32_t *methods);

// Writes a hash of the complete state. Equal states have equal hashes, on every platform.
FarseerStatus farseer_simulator_state_hash(const FarseerSimulator *simulator, uint64_t *hash);

// Takes a snapshot of the simulator without its largest speed and hit speed, keeps it until the next one, and writes its length in bytes.
FarseerStatus farseer_simulator_take_snapshot(const FarseerSimulator *simulator,
                                              size_t *length);

// Copies the snapshot that was taken last, and writes its length in bytes.
//
// # Safety
// An array that is not null has the items that its number says.
FarseerStatus farseer_simulator_copy_snapshot(const FarseerSimulator *simulator,
                                              uint8_t *bytes,
                                              size_t capacity,
                                              size_t *length);

// Replaces the simulator by that of a snapshot of `length` bytes. It continues with the same bits, and ids of that time name the same
// objects. Forget ids that were made since.
//
// # Safety
// An array that is not null has the items that its number says.
FarseerStatus farseer_simulator_restore(const FarseerSimulator *simulator,
                                        const uint8_t *bytes,
                                        size_t length);

// A spring between points of two bodies, in their frames, in length units. Stiffness in mass units/s², damping in mass units/s.
FarseerStatus farseer_spring_create_linear(const FarseerSimulator *simulator,
                                           FarseerBody body1,
                                           FarseerVector2 point1,
                                           FarseerBody body2,
                                           FarseerVector2 point2,
                                           float spring_constant,
                                           float damping_constant,
                                           FarseerSpring *spring);

// A spring between a point of a body, in its frame, and a point of the world, in length units.
// Stiffness in mass units/s², damping in mass units/s.
FarseerStatus farseer_spring_create_fixed_linear(const FarseerSimulator *simulator,
                                                 FarseerBody body,
                                                 FarseerVector2 body_point,
                                                 FarseerVector2 world_point,
                                                 float spring_constant,
                                                 float damping_constant,
                                                 FarseerSpring *spring);

// A spring between the angles of two bodies. Stiffness and damping in torque per radian and per rad/s.
FarseerStatus farseer_spring_create_angle(const FarseerSimulator *simulator,
                                          FarseerBody body1,
                                          FarseerBody body2,
                                          float spring_constant,
                                          float damping_constant,
                                          FarseerSpring *spring);

// A spring that turns a body to an angle. Stiffness and damping in torque per radian and per rad/s.
FarseerStatus farseer_spring_create_fixed_angle(const FarseerSimulator *simulator,
                                                FarseerBody body,
                                                float spring_constant,
                                                float damping_constant,
                                                FarseerSpring *spring);

// Writes whether the spring acts: 0 or 1. A spring that broke is disabled.
FarseerStatus farseer_spring_enabled(const FarseerSimulator *simulator, FarseerSpring spring, int32_t *enabled);

// Sets whether the spring acts: 0 or 1. A spring that broke is disabled.
FarseerStatus farseer_spring_set_enabled(const FarseerSimulator *simulator, FarseerSpring spring, int32_t enabled);

// Writes the stiffness: force per length unit, or torque per radian.
FarseerStatus farseer_spring_spring_constant(const FarseerSimulator *simulator,
                                             FarseerSpring spring,
                                             float *spring_constant);

// Sets the stiffness: force per length unit, or torque per radian.
FarseerStatus farseer_spring_set_spring_constant(const FarseerSimulator *simulator,
                                                 FarseerSpring spring,
                                                 float spring_constant);

// Writes the damping: force per length unit/s, or torque per rad/s.
FarseerStatus farseer_spring_damping_constant(const FarseerSimulator *simulator,
                                              FarseerSpring spring,
                                              float *damping_constant);

// Sets the damping: force per length unit/s, or torque per rad/s.
FarseerStatus farseer_spring_set_damping_constant(const FarseerSimulator *simulator,
                                                  FarseerSpring spring,
                                                  float damping_constant);

// Writes the error, in length units or radians, beyond which the spring breaks.
FarseerStatus farseer_spring_breakpoint(const FarseerSimulator *simulator, FarseerSpring spring, float *breakpoint);

// Sets the error, in length units or radians, beyond which the spring breaks.
FarseerStatus farseer_spring_set_breakpoint(const FarseerSimulator *simulator, FarseerSpring spring, float breakpoint);

// Writes the error of the spring in the last update, in length units or radians.
FarseerStatus farseer_spring_error(const FarseerSimulator *simulator, FarseerSpring spring, float *error);

// Writes a number of yours, which the engine never reads.
FarseerStatus farseer_spring_tag(const FarseerSimulator *simulator, FarseerSpring spring, uint64_t *tag);

// Sets a number of yours, which the engine never reads.
FarseerStatus farseer_spring_set_tag(const FarseerSimulator *simulator, FarseerSpring spring, uint64_t tag);

// Sets the rest length of a linear spring in length units, or the angle of an angle spring in radians.
FarseerStatus farseer_spring_set_target(const FarseerSimulator *simulator, FarseerSpring spring, float target);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* FARSEER_H */
