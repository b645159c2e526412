#pragma once

#include <btBulletDynamicsCommon.h>

#include <span>
#include <vector>

#include "core/math.hpp"
#include "physics/bullet/bullet_world.hpp"
#include "physics/bullet/ragdoll_joint.hpp"
#include "physics/bullet/substep_sweeps.hpp"

namespace lutka::physics {

/// Solves all joints and contacts of a substep by sequential impulses, warm-started, in two passes:
///
///     velocities + forces ──warm start──▶ keep pass (no row asks for more than to stop)
///                                             │──▶ the velocities that the bodies keep
///                                             ▼
///                                         mend pass (rows ask for the speed that mends their position error)
///                                             │──▶ the velocities that move the bodies in this substep
///
/// Mending a gap, a penetration or a limit never feeds energy into the motion, and neither does warm starting (see
/// SubstepSweeps::warmStart()). Joints of ours are solved as blocks of three rows; contacts have a friction cone; any
/// other Bullet constraint is taken row by row as its getInfo2 gives it. docs/physics.md tells the whole.
class SubstepSolver {
  public:
    explicit SubstepSolver(const BulletTuning& tuning) : tuning_(tuning), sweeps_(tuning, rows_) {}
    SubstepSolver(const SubstepSolver&) = delete;
    SubstepSolver& operator=(const SubstepSolver&) = delete;
    ~SubstepSolver() = default;

    /// Writes velocities into the active bodies and moves them. Sleeping bodies are not touched. `seconds` > 0.
    void solve(std::span<btRigidBody* const> bodies, std::span<btTypedConstraint* const> constraints,
               btDispatcher& dispatcher, float seconds);

  private:
    using Island = SubstepIsland;
    using Joint = SubstepJoint;
    // A constraint or manifold and the bodies that it is between.
    template <class T>
    struct Between {
        T* what = nullptr;
        int a = 0;
        int b = 0;
    };
    using Link = Between<btTypedConstraint>;
    using Touch = Between<btPersistentManifold>;

    void takeBodies(std::span<btRigidBody* const> bodies);
    void takeBody(SolverBody& taken, float seconds);
    void takeLinks(std::span<btTypedConstraint* const> constraints);
    void takeTouches(btDispatcher& dispatcher);
    // Puts them in the order of their islands, and otherwise leaves their order.
    template <class T>
    void sortByIsland(std::vector<T>& all, std::vector<T>& sorted, int Island::*first, int Island::*count);
    void solve(std::span<Island> islands, float seconds);
    [[nodiscard]] bool isFree(const Island& island) const;
    void takeRows(std::span<Island> islands, float seconds);
    void takeBodiesOf(const Island& island, float seconds);
    void takeLinksOf(Island& island, float seconds);
    void takeTouchesOf(Island& island, float seconds);
    void takeRagdollJoint(RagdollJoint& constraint, const Link& link, float seconds);
    void takePoint(const RagdollJoint& constraint, const Joint& joint, float rate);
    void takeFriction(const RagdollJoint& constraint, const Joint& joint, float rate);
    void takeAngular(const RagdollJoint& constraint, const Joint& joint, int index, float rate);
    void takeConstraint(const Link& link, float seconds);
    // The number of rows that the constraint wrote into scratch_.
    int askRows(btTypedConstraint& constraint, float seconds);
    void takeContact(btManifoldPoint& point, int a, int b, float seconds);
    void store(std::span<const Island> islands, float seconds);
    void move(std::span<const Island> islands, float seconds);
    void storeFeedback(const Joint& joint, float seconds) const;

    [[nodiscard]] int islandOf(int tag);
    [[nodiscard]] int indexOf(const btCollisionObject& object) const;

    BulletTuning tuning_;
    SubstepRows rows_;
    SubstepSweeps sweeps_;
    std::vector<SolverBody> unsorted_;
    std::vector<Link> links_, unsortedLinks_;  // in the order of their islands, as touches_
    std::vector<Touch> touches_, unsortedTouches_;
    std::vector<int> islandOfTag_;  // -1: none yet
    btAlignedObjectArray<btSolverConstraint> scratch_;
};

}  // namespace lutka::physics
