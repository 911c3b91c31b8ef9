//! Adapter: the stages of joints and springs, as the simulator calls them.

use super::Precise;
use super::joint_import::{JointImport, export_joints};
use super::spring_import::{SpringChoice, import_springs};
use crate::body::entry::Bodies;
use crate::joints::JointId;
use crate::objects::Objects;
use crate::report::Report;
use crate::springs::{SpringForce, SpringId};
use farseer_precise::Solver;
use farseer_precise::index::BodyIndex;
use farseer_precise::scaled_parameters::StepContext;

impl Precise {
    /// Returns the import of joints and springs from the bodies `objects` of the game.
    pub(crate) fn joint_import<'a>(&'a self, objects: &'a Bodies) -> JointImport<'a> {
        JointImport::new(
            objects,
            (&self.solver.bodies, &self.ids),
            &self.solver.sleep,
            self.solver.depth.as_ref(),
        )
    }

    /// Marks the joints as edited, so that the next step imports them again.
    pub(crate) fn invalidate_joints(&mut self) {
        self.joint_table.invalidate();
    }

    /// Returns whether some joint may break: it has a finite breakpoint (limit of its position error), or edited joints have
    /// not been imported yet.
    pub(crate) fn may_break_joints(&self) -> bool {
        self.joint_table.may_break()
    }

    /// Returns the joint that was active in this update with this index; `None` if there is none.
    pub(crate) fn joint_at(&self, index: usize) -> Option<JointId> {
        self.joint_table.joint_at(index)
    }

    /// Fourth stage of a step: moves the joint constraints to the poses of this step, prepares their solvers, and builds the
    /// springs that are rows. Imports the joints first if one was edited.
    pub(crate) fn import_joints(&mut self, objects: &Objects, step: &StepContext) {
        self.axis_locks.stop(&self.ids, &mut self.solver);
        let Precise {
            solver: Solver { joints, springs, bodies, sleep, depth, .. },
            joint_table,
            ids,
            axis_locks,
            ..
        } = self;
        let import = JointImport::new(&objects.bodies, (bodies, ids), sleep, depth.as_ref());
        let springs_signature = import_springs(joint_table, springs, import, objects);
        joints.begin_update(self.solver.parameters.length_unit);
        import.reimport_joints(joint_table, joints, (objects, axis_locks));
        let (joints_signature, are_indices_new) = joint_table.take_signature();
        let import = JointImport::new(&objects.bodies, (bodies, ids), sleep, depth.as_ref());
        let servos_signature = import.add_servos(joint_table, springs, (objects, step));
        self.solver
            .direct_solver
            .note_joints(joints_signature ^ springs_signature ^ servos_signature, are_indices_new);
        springs.begin_step(bodies, step.dt);
        if joints.is_empty() {
            return;
        }
        let all_touched = self.solver.constraints.has_overflow();
        let is_touched = |body: BodyIndex| {
            all_touched || !self.solver.color_usage.has_no_constraint(body) || springs.is_attached_to(body)
        };
        // World boxes on a hinge count as touched.
        let may_touch = !self.solver.constraints.has_none() || !springs.is_empty() || depth.is_some();
        let import = JointImport::new(&objects.bodies, (bodies, ids), sleep, depth.as_ref());
        import.prepare_joints(joint_table, joints, objects, step, may_touch.then_some(is_touched));
    }

    /// Starts the springs of an update: clears the list of springs that are rows, and imports edited joints, by which
    /// [`constrain_spring`](Self::constrain_spring) decides.
    pub(crate) fn begin_springs(&mut self, objects: &Objects) {
        let Precise {
            solver: Solver { joints, bodies, sleep, depth, .. }, joint_table, ids, axis_locks, ..
        } = self;
        joint_table.row_springs.clear();
        if depth.is_none() && !objects.springs.list().is_empty() {
            JointImport::new(&objects.bodies, (bodies, ids), sleep, None).reimport_joints(
                joint_table,
                joints,
                (objects, axis_locks),
            );
        }
    }

    /// Decides whether a spring is a row in this update, and adds it to the list of rows if so. Returns whether it is a row;
    /// the caller must not apply the explicit forces `pushes` then.
    pub(crate) fn constrain_spring(
        &mut self,
        id: SpringId,
        pushes: [Option<SpringForce>; 2],
        objects: &Objects,
    ) -> bool {
        if self.solver.depth.is_some() {
            return false;
        }
        let choice = SpringChoice {
            import: self.joint_import(&objects.bodies),
            joints: &self.solver.joints,
            pairs: &self.solver.pairs,
            proxies: &self.solver.proxies,
        };
        let accelerations = choice.row_accelerations(&objects.springs[id], pushes);
        self.joint_table.row_springs.extend(accelerations.map(|accelerations| (id, accelerations)));
        accelerations.is_some()
    }

    /// Writes error, anchors and force to the joints in `objects`. Joints whose load exceeds their greatest force or torque
    /// break, and `report` gets an event for each.
    pub(crate) fn export_joints(&mut self, objects: &mut Objects, report: &mut Report) {
        export_joints(&mut self.joint_table, &mut self.solver.joints, objects, report);
    }
}
