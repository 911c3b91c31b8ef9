//! The 2.5D engine.

mod abuse;
mod api;
mod callbacks;
mod carried;
mod closed_forms;
mod doors;
mod edited_links;
mod edits;
mod fields;
mod fixed_springs;
mod joints;
mod meeting;
mod motion;
mod one_plane;
mod one_way;
mod pairs;
mod pins;
mod platforms;
mod precise;
mod queries;
mod random;
mod rays;
mod regressions;
mod ropes;
mod save;
mod scheme_in_mid_run;
mod seams;
mod sleep;

mod slopes;
mod spawning;
mod supports;
mod thesis;
mod walking;
