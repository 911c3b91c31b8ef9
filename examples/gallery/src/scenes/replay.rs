//! Recordings of the 2D engine: a run of a game at any step, and two runs beside each other.

use std::rc::Rc;

use examples::Result;
use farseer_core::{PhysicsSimulator, Recording};
use twohalf_render::{Canvas, Color, Text, Transform};

use super::blocks::{bounds, draw_world, fit};
use crate::keys::Key;
use crate::play::{Play, Player, World, WorldMut};

const EXACT: Color = Color::rgb(200, 230, 200);
const PARTED: Color = Color::rgb(255, 140, 120);

/// A recording at one of its steps.
///
/// Keyframes are exact. The steps between are made without the input of the game, which only the game can repeat: the hash of
/// each tells whether it is that of the recorded run.
#[derive(Debug, Clone)]
pub(super) struct Replay {
    recording: Rc<Recording>,
    /// Number of steps made, 0 to the length of the recording.
    at: usize,
    simulator: Box<PhysicsSimulator>,
    /// First step in which it differs from the run beside it, counted from 0.
    parts_at: Option<usize>,
    size: [f32; 2],
    camera: Transform,
}

impl Replay {
    /// A recording after a number of steps, or at its end. `parts_at`: the first step in which it differs from another run.
    ///
    /// # Errors
    /// A keyframe that cannot be restored.
    pub(super) fn new(recording: Rc<Recording>, at: usize, parts_at: Option<usize>) -> Result<Self> {
        let mut replay = Replay {
            simulator: Box::default(),
            at: 0,
            recording,
            parts_at,
            size: [0.0; 2],
            camera: Transform::IDENTITY,
        };
        replay.go_to(0)?;
        (replay.size, replay.camera) = fit(bounds(&replay.simulator));
        replay.go_to(at)?;
        Ok(replay)
    }

    /// Goes to the state after a number of steps, at most to the end.
    fn go_to(&mut self, steps: usize) -> Result<()> {
        let steps = steps.min(self.recording.len());
        let interval = self.recording.keyframe_interval() as usize;
        let keyframe = steps / interval;
        self.simulator.restore(self.recording.keyframe(keyframe).ok_or("there is no such keyframe")?)?;
        for step in keyframe * interval..steps {
            self.simulator.update(self.recording.dt(step).unwrap_or_default());
        }
        self.at = steps;
        Ok(())
    }

    /// Whether the shown state is that of the recorded run.
    fn is_exact(&self) -> bool {
        let recorded = self.at.checked_sub(1).and_then(|step| self.recording.hash(step));
        recorded.is_none_or(|hash| hash == self.simulator.state_hash())
    }

    /// Line about the shown state.
    fn line(&self) -> String {
        let input = self.at.checked_sub(1).and_then(|step| self.recording.input(step)).map_or(0, <[u8]>::len);
        let mut line = format!("step {} of {}", self.at, self.recording.len());
        if input > 0 {
            line += &format!(", input of {input} bytes");
        }
        if !self.is_exact() {
            line += ", without the game's input";
        }
        match self.parts_at {
            Some(parting) if parting < self.at => line += &format!(", parted in step {}", parting + 1),
            Some(parting) => line += &format!(", will part in step {}", parting + 1),
            None => {}
        }
        line
    }
}

impl Play for Replay {
    fn size(&self) -> [f32; 2] {
        self.size
    }

    fn rate(&self) -> u32 {
        let dt = self.recording.dt(0).unwrap_or(1.0 / 60.0);
        (1.0 / dt).round().clamp(10.0, 1000.0) as u32
    }

    fn step(&mut self, player: Player) -> Result<()> {
        let interval = self.recording.keyframe_interval() as i64;
        let way = match player {
            Player::Script => 1,
            Player::Keys(keys) if keys.pressed.contains(Key::Jump) => {
                let parting = self.parts_at.map_or(self.recording.len(), |step| step + 1);
                parting as i64 - self.at as i64
            }
            Player::Keys(keys) => {
                let [steps, keyframes] = [[Key::Left, Key::Right], [Key::Down, Key::Up]]
                    .map(|[less, more]| keys.axis(less, more) as i64);
                steps + keyframes * interval
            }
        };
        let next = (self.at as i64 + way).max(0) as usize;
        if way == 1 && next <= self.recording.len() && !next.is_multiple_of(interval as usize) {
            self.simulator.update(self.recording.dt(self.at).unwrap_or_default());
            self.at = next;
            return Ok(());
        }
        if way != 0 { self.go_to(next) } else { Ok(()) }
    }

    fn draw(&self, canvas: &mut dyn Canvas) -> Result<()> {
        draw_world(&self.simulator, &self.camera, true, canvas);
        let has_parted = self.parts_at.is_some_and(|parting| parting < self.at);
        let color = if has_parted || !self.is_exact() { PARTED } else { EXACT };
        let text = Text { scale: [2.0; 2], color, ..Text::new(self.line(), [10.0, self.size[1] - 28.0]) };
        Text { color: Color::BLACK, position: [11.0, self.size[1] - 27.0], ..text.clone() }.draw(canvas);
        text.draw(canvas);
        Ok(())
    }

    fn world(&self) -> World<'_> {
        World::Plane(&self.simulator)
    }

    fn world_mut(&mut self) -> WorldMut<'_> {
        WorldMut::Plane(&mut self.simulator)
    }

    fn camera(&self) -> Transform {
        self.camera
    }

    fn copy(&self) -> Box<dyn Play> {
        Box::new(self.clone())
    }
}
