//! Films a sample scene of the original.

use std::path::Path;

use conformance::samples::{BACKGROUND, SCREEN, SampleScene};
use farseer_core::PhysicsSimulatorView;
use twohalf_render::{Canvas, Color, SoftwareCanvas, Texture2D, Transform, draw_debug_view};

use crate::sample_picture::{color, draw_sample};
use crate::{Recorder, Result};

/// Steps per second of the sample scenes.
const SAMPLE_RATE: u32 = 100;

/// Options of the film of a sample scene.
#[derive(Debug)]
pub struct SampleFilm {
    /// Begins the names of the files.
    pub name: &'static str,
    /// Length of the film in s.
    pub seconds: u32,
    /// Times in s of the six stills, ascending.
    pub stills: &'static [f32],
    /// Drawn behind the scene.
    pub picture: Option<Texture2D>,
    /// Whether the original's debug view is drawn over the pictures.
    pub wants_debug_view: bool,
}

/// A running scene, and the greatest number of contacts that a step solved.
struct Filmed<'a> {
    scene: &'a mut SampleScene,
    most_contacts: usize,
}

impl SampleFilm {
    /// Films a scene into a folder; returns a report.
    ///
    /// # Errors
    /// A file that cannot be written, or an error of the scene.
    pub fn film(&self, folder: &Path, title: &str, scene: &mut SampleScene) -> Result<String> {
        let size = SCREEN.map(|side| side as u32);
        let mut backdrop = SoftwareCanvas::new(size[0], size[1])?;
        draw_backdrop(&mut backdrop, self.picture.as_ref());
        let recorder = Recorder {
            name: self.name,
            size,
            shrink: 3,
            steps_per_second: SAMPLE_RATE,
            seconds: self.seconds,
            stills: self.stills,
        };
        // The original makes one step before it shows a scene for the first time.
        scene.step()?;
        let mut filmed = Filmed { scene, most_contacts: 0 };
        let step = |filmed: &mut Filmed<'_>| {
            filmed.scene.step()?;
            filmed.most_contacts =
                filmed.most_contacts.max(filmed.scene.simulator().counters().contacts_solved);
            Ok(())
        };
        let summary = recorder.film(folder, &mut filmed, &backdrop, step, |filmed, canvas| {
            draw_sample(filmed.scene, canvas);
            if self.wants_debug_view {
                let view =
                    PhysicsSimulatorView { enable_performance_panel_view: false, ..Default::default() };
                draw_debug_view(&view, filmed.scene.simulator(), canvas);
            }
            Ok(())
        })?;
        let most_contacts = filmed.most_contacts;
        let simulator = scene.simulator();
        Ok(format!(
            "{title}\n  {} steps of 1/{SAMPLE_RATE} s, {} bodies, {} joints, {} springs, up to {most_contacts} contact \
             points at a time, {:.1} us per step\n  animation: {}\n  stills:    {}",
            summary.steps,
            simulator.body_list().len(),
            simulator.joint_list().len(),
            simulator.spring_list().len(),
            summary.mean_step.as_secs_f64() * 1e6,
            summary.animation.display(),
            summary.contact_sheet.display(),
        ))
    }
}

fn draw_backdrop(canvas: &mut SoftwareCanvas, picture: Option<&Texture2D>) {
    canvas.clear(color(BACKGROUND));
    if let Some(picture) = picture {
        canvas.draw_texture(picture, &Transform::IDENTITY, Color::WHITE, None);
    }
}
