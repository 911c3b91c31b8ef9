//! scratch
mod twohalf_common;
use twohalf_common::*;
use twohalf::*;
#[test]
fn ramp() {
  for speed in [20.0f32, 50.0, 100.0, 200.0] { for angle in [-0.05f32, -0.1, -0.2, -0.3] {
    let mut bad = 0; let mut worst = f32::MAX; let mut best = 0.0f32;
    for phase in 0..100 {
    let mut s = simulator();
    let p = platform(&mut s, [200.0, 20.0, 200.0], [-100.0, 80.0, 0.0]); set_platform_surface(&mut s, p, 0.0, 0.0);
    let c = Vector3::new(100.0*angle.cos(), 100.0 - 100.0*angle.sin(), 0.0) - Vector3::new(angle.sin(), angle.cos(), 0.0)*10.0;
    let p = Platform::with_rotation(&mut s, 200.0, 20.0, 200.0, Vector3::new(c.x, c.y-10.0, c.z), angle, None).unwrap(); set_platform_surface(&mut s, p, 0.0, 0.0);
    let body = solid(&mut s, [40.0,20.0,20.0], [-40.0 - speed * DT * phase as f32 / 100.0, 102.0, 0.0]);
    run(&mut s, 100);
    throw(&mut s, body, [speed, 0.0, 0.0]);
    for _ in 0..3000 { s.update(DT); if s.contacts().count() > 2 || place(&s, body).x > -20.0 + 3.0 * speed * DT { break; } }
    run(&mut s, 3);
    let v = velocity(&s, body).x;
    if v < speed * 0.5 { bad += 1; } worst = worst.min(v); best = best.max(v);
    }
    println!("speed {speed} angle {angle}: bad {bad}/100 worst {worst} best {best}");
  }}
}
