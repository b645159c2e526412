#pragma once

#include <btBulletDynamicsCommon.h>

#include <span>
#include <vector>

#include "core/math.hpp"
#include "physics/bullet/bullet_world.hpp"
#include "physics/bullet/ragdoll_joint.hpp"
#include "physics/bullet/solver_rows.hpp"
#include "physics/bullet/warm_started.hpp"

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
/// warmStart()). Joints of ours are solved as blocks of three rows; contacts have a friction cone; any other Bullet
/// constraint is taken row by row as its getInfo2 gives it. docs/physics.md tells the whole.
class SubstepSolver {
  public:
    explicit SubstepSolver(const BulletTuning& tuning) : tuning_(tuning) {}

    /// Writes velocities into the active bodies and moves them. Sleeping bodies are not touched. `seconds` > 0.
    void solve(std::span<btRigidBody* const> bodies, std::span<btTypedConstraint* const> constraints,
               btDispatcher& dispatcher, float seconds);

  private:
    // The rows of one constraint.
    struct Joint {
        int a = 0;
        int b = 0;
        int point = -1;        // into points_; -1: none
        int friction = -1;     // into frictions_; -1: none
        int firstAngular = 0;  // into angulars_
        int angulars = 0;
        int firstGeneral = 0;  // into generals_
        int generals = 0;
        btTypedConstraint* constraint = nullptr;
        RagdollJoint* ragdoll = nullptr;  // the constraint, where it is one of ours
        WarmStarted* warm = nullptr;      // null: all rows keep, from no impulse
    };
    struct Island {
        int firstBody = 0;  // into bodies_
        int bodies = 0;
        int firstLink = 0;  // into links_
        int links = 0;
        int firstTouch = 0;  // into touches_
        int touches = 0;
        int firstJoint = 0;  // into joints_
        int joints = 0;
        int firstContact = 0;  // into contacts_
        int contacts = 0;
        float gain = 0;  // see warmStart()
        float square = 0;
        float share = 0;
        float mass = 0;    // kg, of all bodies
        float motion = 0;  // twice the energy of their centres, J; both as of calm()

        // By the root mean square over the mass.
        [[nodiscard]] bool isSlowerThan(float speed) const { return motion < speed * speed * mass; }
    };
    // A constraint or manifold and the bodies that it is between.
    template <class T>
    struct Between {
        T* what = nullptr;
        int a = 0;
        int b = 0;
    };
    using Link = Between<btTypedConstraint>;
    using Touch = Between<btPersistentManifold>;
    // An island that is being swept; both as solveJoint() returns them.
    struct Sweeping {
        const Island* island = nullptr;
        float tolerance = 0;
        float residual = 0;
    };
    static constexpr std::size_t kTogether = 2;  // islands solved in turn

    void takeBodies(std::span<btRigidBody* const> bodies);
    void takeBody(SolverBody& taken, float seconds);
    void takeLinks(std::span<btTypedConstraint* const> constraints);
    void takeTouches(btDispatcher& dispatcher);
    // Puts them in the order of their islands, and otherwise leaves their order.
    template <class T>
    void sortByIsland(std::vector<T>& all, std::vector<T>& sorted, int Island::*first, int Island::*count);
    void solve(std::span<Island> islands, float seconds);
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
    void warmStart(std::span<Island> islands);
    // Visits a joint's rows of every kind.
    template <class Visit>
    void forRows(const Joint& joint, const Visit& visit);
    void gatherPushes();
    void applyShares();
    void calm(Island& island, float seconds);
    void iterate(std::span<const Island> islands, bool mending);
    // The squares of the speed by which rows were wrong, m²/s² (angular rows: of a point at an arm's length).
    float solveJoint(const Joint& joint, bool mending);
    float solveContact(ContactRows& contact, bool mending);
    void sweep(std::span<Sweeping> sweepings, bool mending, bool forth);
    void bounce();
    void store(std::span<const Island> islands, float seconds);
    void move(std::span<const Island> islands, float seconds);
    void storeFeedback(const Joint& joint, float seconds) const;

    [[nodiscard]] Island& islandOfPair(int a, int b) { return islands_[bodies_[a != 0 ? a : b].island]; }
    [[nodiscard]] std::span<SolverBody> bodiesOf(const Island& island) {
        return std::span(bodies_).subspan(island.firstBody, island.bodies);
    }
    [[nodiscard]] int islandOf(int tag);
    [[nodiscard]] int indexOf(const btCollisionObject& object) const;

    BulletTuning tuning_;
    std::vector<SolverBody> bodies_;  // [0] never moves; then in the order of their islands, as links_ and touches_
    std::vector<SolverBody> unsorted_;
    std::vector<Link> links_, unsortedLinks_;
    std::vector<Touch> touches_, unsortedTouches_;
    // Rows of the islands at hand only, in their order: so few that they stay in the processor's nearest caches.
    std::vector<Joint> joints_;
    std::vector<PointRows> points_;
    std::vector<TurnFriction> frictions_;
    std::vector<AngularRow> angulars_;
    std::vector<GeneralRow> generals_;
    std::vector<ContactRows> contacts_;
    std::vector<PushSum> pushes_;   // one a body
    std::vector<Island> islands_;   // by SolverBody::island
    std::vector<int> islandOfTag_;  // -1: none yet
    btAlignedObjectArray<btSolverConstraint> scratch_;
};

}  // namespace lutka::physics
