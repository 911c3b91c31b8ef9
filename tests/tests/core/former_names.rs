//! The names of version 0.1 still compile and mean the same.

#![allow(deprecated, reason = "this is about deprecated names")]

use farseer_core::{
    AwakeReason, IslandChoice, IslandMethod, IslandSolver, PhysicsSimulator, SolverChoice, SolverReason,
    WhyAwake, WhyMethod,
};

#[test]
fn former_variants_are_patterns_and_values_of_the_new_enums() {
    let solvers =
        [IslandSolver::Ballistic, IslandSolver::Articulated, IslandSolver::Direct, IslandSolver::Iterative];
    let former = [IslandMethod::Flight, IslandMethod::Swing, IslandMethod::Whole, IslandMethod::Passes];
    assert_eq!(former, solvers);
    assert!(matches!(IslandSolver::Direct, IslandMethod::Whole));
    let choices = [SolverChoice::Auto, SolverChoice::Direct, SolverChoice::Iterative];
    assert_eq!([IslandChoice::ByItself, IslandChoice::Whole, IslandChoice::Passes], choices);
    assert_eq!(WhyMethod::Chosen, SolverReason::Chosen);
    assert_eq!(WhyAwake::NothingSleeps, AwakeReason::SleepDisabled);
}

#[test]
fn former_setters_set_the_solver_choice() {
    let mut simulator = PhysicsSimulator::default();
    simulator.set_island_choice(IslandChoice::Passes);
    assert_eq!(simulator.solver_choice(), SolverChoice::Iterative);
    assert_eq!(simulator.island_choice(), SolverChoice::Iterative);
}

#[test]
fn a_solver_choice_is_saved_under_its_former_name() {
    assert_eq!(serde_json::to_string(&SolverChoice::Auto).unwrap(), "\"ByItself\"");
    assert_eq!(serde_json::from_str::<SolverChoice>("\"Whole\"").unwrap(), SolverChoice::Direct);
}
