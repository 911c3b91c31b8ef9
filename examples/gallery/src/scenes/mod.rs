//! The table of scenes.

mod blocks;
mod crowd;
mod games;
mod replay;
mod samples;
mod telling;
mod thesis;

use std::rc::Rc;

use conformance::samples::{SAMPLES, sample};
use conformance::scene::Scene;
use examples::Result;
use farseer_core::Recording;
use twohalf::DepthScheme;

use crate::play::{Play, Set};
use crate::show::{Build, Half, Show};

/// Instructions for the player of a scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Game {
    /// None: the scene is no game.
    None,
    /// Two flippers and a launch.
    Pinball,
    /// To walk, jump, strike, lift and throw.
    Brawler,
    /// To go through the steps of a recording.
    Replay,
}

/// A scene of the gallery.
#[derive(Clone)]
pub struct GalleryScene {
    /// Its name, as in a command or an address.
    pub name: String,
    /// Its title.
    pub title: String,
    /// One sentence.
    pub about: String,
    /// Whether it is a game.
    pub game: Game,
    build: Rc<dyn Fn() -> Result<Show>>,
}

impl std::fmt::Debug for GalleryScene {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "GalleryScene({:?})", self.name)
    }
}

impl GalleryScene {
    /// Builds it in its initial state.
    ///
    /// # Errors
    /// A refusal of the engine, which only a file can cause.
    pub fn build(&self) -> Result<Show> {
        (self.build)()
    }

    /// A scene from a file: a recording, or JSON in the format of the tests.
    ///
    /// # Errors
    /// A file that cannot be read, or is no such scene.
    pub fn from_file(path: &std::path::Path) -> Result<Self> {
        let bytes = std::fs::read(path)?;
        if is_recording(&bytes) {
            return GalleryScene::from_bytes(&path.display().to_string(), &bytes);
        }
        GalleryScene::of(Scene::from_file(path)?)
    }

    /// A scene from the content of a file; `name` replaces the file in errors.
    ///
    /// # Errors
    /// A content that is no such scene.
    pub fn from_bytes(name: &str, bytes: &[u8]) -> Result<Self> {
        if is_recording(bytes) {
            return GalleryScene::from_recordings(name, vec![Recording::from_bytes(bytes)?], 0);
        }
        GalleryScene::from_json(name, &String::from_utf8_lossy(bytes))
    }

    /// A recording after a number of steps, or two beside each other, with the step in which they part.
    ///
    /// # Errors
    /// A recording whose states cannot be restored; more than two, or none.
    pub fn from_recordings(name: &str, recordings: Vec<Recording>, step: usize) -> Result<Self> {
        let (parts_at, about) = match recordings.as_slice() {
            [one] => (None, format!("A run of {} steps.", one.len())),
            [one, other] => match one.first_difference(other) {
                None => (None, format!("Two equal runs of {} steps.", one.len())),
                Some(parting) => (Some(parting), format!("Two runs that part in step {}.", parting + 1)),
            },
            _ => return Err("one recording can be shown, or two".into()),
        };
        let labels: &[&'static str] = if recordings.len() == 2 { &["one", "other"] } else { &[""] };
        let runs: Vec<_> = recordings.into_iter().map(Rc::new).zip(labels).collect();
        let show = move || {
            let half = |(run, label): &(Rc<Recording>, &&'static str)| {
                let run = run.clone();
                let make = build(move |_| Ok(Box::new(replay::Replay::new(run.clone(), step, parts_at)?)));
                Half::new(label, Set::Precise, false, make)
            };
            Ok(Show::new(runs.iter().map(half).collect::<Result<_>>()?))
        };
        show()?;
        Ok(entry(name, &name.replace('_', " "), &about, Game::Replay, show))
    }

    /// A scene from a text of JSON in the format of the tests; `name` replaces the file in errors.
    ///
    /// # Errors
    /// A text that is no such scene.
    pub fn from_json(name: &str, text: &str) -> Result<Self> {
        GalleryScene::of(Scene::from_json(name, text)?)
    }

    fn of(scene: Scene) -> Result<Self> {
        // A run borrows its scene. A program opens few files, and shows each of them as long as it runs.
        let scene: &'static Scene = Box::leak(Box::new(scene));
        let build = build(move |set| {
            let mut play = blocks::Blocks::of_file(scene)?;
            if set == Set::Precise {
                crate::state::switch(play.world_mut(), set)?;
            }
            Ok(Box::new(play))
        });
        build(Set::Faithful)?;
        let half = move || Ok(Show::new(vec![Half::new("", Set::Faithful, true, build.clone())?]));
        let (name, about) = (scene.name.clone(), scene.about.clone());
        Ok(GalleryScene {
            title: name.replace('_', " "),
            name,
            about,
            game: Game::None,
            build: Rc::new(half),
        })
    }
}

/// Whether the bytes of a file begin as a recording does.
pub fn is_recording(bytes: &[u8]) -> bool {
    bytes.starts_with(&Recording::MAGIC)
}

/// With depth: the scheme of a set.
pub(crate) fn scheme(set: Set) -> DepthScheme {
    match set {
        Set::Faithful => DepthScheme::Faithful,
        Set::Precise => DepthScheme::Precise,
    }
}

fn build(make: impl Fn(Set) -> Result<Box<dyn Play>> + 'static) -> Build {
    Rc::new(make)
}

fn entry(
    name: &str,
    title: &str,
    about: &str,
    game: Game,
    show: impl Fn() -> Result<Show> + 'static,
) -> GalleryScene {
    let [name, title, about] = [name, title, about].map(str::to_owned);
    GalleryScene { name, title, about, game, build: Rc::new(show) }
}

/// With the faithful set on the left and the precise one on the right.
fn both(
    name: &str,
    title: &str,
    about: &str,
    make: impl Fn(Set) -> Result<Box<dyn Play>> + 'static,
) -> GalleryScene {
    let make = build(make);
    entry(name, title, about, Game::None, move || {
        let half = |set| Half::new("2D", set, true, make.clone());
        Ok(Show::new(vec![half(Set::Faithful)?, half(Set::Precise)?]))
    })
}

/// One alone, with the precise set.
fn alone(
    name: &str,
    title: &str,
    about: &str,
    game: Game,
    make: impl Fn(Set) -> Result<Box<dyn Play>> + 'static,
) -> GalleryScene {
    let make = build(make);
    entry(name, title, about, game, move || {
        Ok(Show::new(vec![Half::new("", Set::Precise, game == Game::None, make.clone())?]))
    })
}

/// All scenes, in the order in which they are listed.
pub fn scenes() -> Vec<GalleryScene> {
    let mut all = thesis_scenes();
    all.extend([
        alone(
            "brawler",
            "Beat-'em-up",
            "A street in 2.5D: walk, jump, strike, lift and throw, over a hole, a belt, a pond and a lift.",
            Game::Brawler,
            |_| games::brawler(),
        ),
        alone(
            "pinball",
            "Pinball",
            "A table in 2D: flippers on springs, bumpers, lights, and a ramp over it all.",
            Game::Pinball,
            |_| games::pinball(),
        ),
    ]);
    all.extend(telling_scenes());
    all.extend([1000, 10_000].map(|count| {
        alone(
            &format!("crowd_{count}"),
            &format!("{count} objects in 2.5D"),
            "Balls and crates fall on a field with platforms, roll, meet, and fall asleep.",
            Game::None,
            move |set| crowd::crowd(set, count),
        )
    }));
    all.extend(sample_scenes());
    all
}

fn thesis_scenes() -> Vec<GalleryScene> {
    let scene = |number: u32, about: &str| {
        entry(
            &format!("demo_scene_{number}"),
            &format!("Demo Scene {number}"),
            about,
            Game::None,
            move || {
                let plane =
                    Half::new("2D", Set::Faithful, true, build(move |set| thesis::plane(number, set)))?;
                let depth =
                    Half::new("2.5D", Set::Precise, true, build(move |set| thesis::depth(number, set)))?;
                Ok(Show::new(vec![plane, depth]))
            },
        )
    };
    vec![
        scene(
            2,
            "The thesis' second scene, in 2D and in 2.5D: things fall on a platform and a slope, and roll down.",
        ),
        scene(
            1,
            "The thesis' first scene, in 2D and in 2.5D: things fall on a floor, and on a ground with depth.",
        ),
    ]
}

fn telling_scenes() -> Vec<GalleryScene> {
    vec![
        both("column_20", "Column of 20", "Twenty boxes on each other: one set lets them fall.", |set| {
            telling::column(set, 20)
        }),
        both(
            "column_100",
            "Column of 100",
            "A hundred boxes on each other: the precise set lets them stand.",
            |set| telling::column(set, 100),
        ),
        both("pyramid", "Pyramid of 210", "A pyramid of boxes, which stands, or creeps.", |set| {
            telling::pyramid_of(set, 20)
        }),
        both(
            "chain_200",
            "Chain of 200",
            "Two hundred links on hinges swing down: one set stretches them.",
            |set| telling::chain(set, 200),
        ),
        both(
            "mass_ratio",
            "A thousand to one",
            "A heavy box on light ones, and a heavy ball on a light chain.",
            telling::mass_ratio,
        ),
        both("pit_500", "Pit of 500", "Five hundred circles fall into a pit.", |set| telling::pit(set, 500)),
    ]
}

/// Subjects of the original's samples, by their names there. Two of its twenty are missing. Advanced 1 keeps 120 balls alive at
/// random places to show the saving of a pool of objects. Advanced 7 is empty until the user puts polygons there to cut or to
/// unite.
const SAMPLE_TITLES: [[&str; 3]; 18] = [
    ["Water", "Water", "A raft with a heap of blocks on water that makes waves."],
    ["Simple 1", "A single body", "A body that is pushed and turned."],
    ["Simple 2", "Two bodies", "Two bodies with geoms."],
    ["Simple 3", "Several geoms", "Bodies of several geoms, and static ones."],
    ["Simple 4", "Stacked objects", "A pyramid of boxes, and something that runs into it."],
    ["Simple 5", "Collision categories", "Rows of balls that meet only some of the others."],
    ["Simple 6", "Springs", "Linear springs and angular ones."],
    ["Simple 7", "Spiders", "Spiders whose joints seek angles."],
    ["Simple 8", "1,600 balls", "Sixteen hundred balls that meet nothing but the agent."],
    ["Simple 9", "Ragdoll", "Bodies of limbs on joints."],
    ["Simple 10", "Welds and gears", "Tables whose legs break off, and gears."],
    ["Advanced 2", "Inactivity", "A pyramid whose resting bodies are switched off."],
    ["Advanced 3", "Outlines of textures", "Bodies whose outlines were traced."],
    ["Advanced 4", "Chains", "Chains of several kinds of links."],
    ["Advanced 5", "Paths", "Tracks and bridges along curves."],
    ["Advanced 6", "Wind and explosions", "A hair dryer and grenades."],
    ["Advanced 8", "Lines", "What lines meet."],
    ["Advanced 9", "Concave outlines", "Splats that are cut into convex pieces."],
];

fn sample_scenes() -> Vec<GalleryScene> {
    let known = SAMPLE_TITLES.iter().filter_map(|[name, title, about]| Some((sample(name)?, title, about)));
    debug_assert_eq!(SAMPLES.len(), SAMPLE_TITLES.len());
    known
        .map(|(sample, title, about)| {
            let name = format!("farseer_{}", sample.name.to_lowercase().replace(' ', "_"));
            let make = build(move |set| samples::sample(sample, set));
            entry(&name, &format!("Farseer: {title}"), about, Game::None, move || {
                Ok(Show::new(vec![Half::new("", Set::Faithful, true, make.clone())?]))
            })
        })
        .collect()
}
