#pragma once

#include <btBulletDynamicsCommon.h>

#include <span>
#include <vector>

#include "core/math.hpp"
#include "physics/bullet/bullet_world.hpp"
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

    /// Writes velocities into the active bodies; what moves them in this substep is kept for moveBodies(). Sleeping
    /// bodies are not touched. `seconds` > 0.
    void solve(std::span<btRigidBody* const> bodies, std::span<btTypedConstraint* const> constraints,
               btDispatcher& dispatcher, float seconds);

    /// Moves the active bodies of the last solve().
    void moveBodies(float seconds);

  private:
    struct Body {
        btRigidBody* body = nullptr;  // null: the body that never moves
        vec3 velocity{0, 0, 0};
        vec3 turn{0, 0, 0};
        int island = 0;  // of those that touch or are linked
        float inverseMass = 0;
        mat3 inverseInertia{0};  // world
    };
    // One scalar equation J v = target with bounds on its impulse.
    struct Row {
        vec3 linearA, angularA, linearB, angularB;  // J
        vec3 turnA, turnB;                          // inverse inertia times the angular parts
        float softness = 0;                         // J v + softness · impulse = target
        float inverseEffectiveMass = 0;             // 1 / (J M⁻¹ Jᵀ + softness)
        float mendTarget = 0;
        float keepTarget = 0;
        float low = 0;
        float high = 0;
        float impulse = 0;
        RowDuty duty = RowDuty::keeps;
    };
    // The rows of one constraint, [first, first + count) in rows_.
    struct Joint {
        int a = 0;
        int b = 0;
        int first = 0;
        int count = 0;
        btTypedConstraint* constraint = nullptr;
        WarmStarted* warm = nullptr;  // null: all rows keep, from no impulse
        bool block = false;           // the first three rows are solved together
        mat3 inverseBlock{0};         // inverse of their J M⁻¹ Jᵀ
    };
    struct Contact {
        int a = 0;
        int b = 0;
        btManifoldPoint* point = nullptr;
        Row normal;
        Row tangents[2];
        float friction = 0;
        vec3 rolling{0, 0, 0};     // impulse that resists rolling, N m s
        float rollingInertia = 0;  // kg m², no more than about any axis
        float bounceTarget = 0;    // speed of parting that restitution asks for
    };

    // What warm starting sums up.
    struct Push {
        vec3 linear{0, 0, 0};
        vec3 angular{0, 0, 0};
    };
    struct Island {
        int firstJoint = 0;  // into jointOrder_
        int joints = 0;
        int firstContact = 0;  // into contactOrder_
        int contacts = 0;
        float gain = 0;  // see warmStart()
        float square = 0;
        float share = 0;
    };

    void takeBodies(std::span<btRigidBody* const> bodies, float seconds);
    void takeConstraints(std::span<btTypedConstraint* const> constraints, float seconds);
    void takeConstraint(btTypedConstraint& constraint, float seconds);
    // The number of rows that the constraint wrote into scratch_.
    int askRows(btTypedConstraint& constraint, float seconds);
    [[nodiscard]] mat3 inverseBlockOf(const Joint& joint) const;
    void takeContacts(btDispatcher& dispatcher, float seconds);
    void takePoint(btManifoldPoint& point, int a, int b, float seconds);
    void finishRow(Row& row, int a, int b) const;
    void warmStart();
    void sortByIsland();
    void calm(float seconds);
    void iterate(bool mending);
    // These return the speed by which rows were wrong, m/s (angular rows: of a point at an arm's length).
    float sweep(const Island& island, bool mending, bool forth);
    float solveJoint(Joint& joint, bool mending);
    float solveContact(Contact& contact, bool mending);
    void solveRolling(Contact& contact);
    float solveRow(Row& row, int a, int b, bool mending);
    void bounce();
    void store(float seconds);
    void storeFeedback(const Joint& joint, float seconds) const;

    [[nodiscard]] float speedAlong(const Row& row, int a, int b) const;
    void apply(const Row& row, int a, int b, float impulse);
    template <class Visit>
    void forEachRow(const Visit& visit);
    [[nodiscard]] int islandOf(int tag);
    [[nodiscard]] int indexOf(const btCollisionObject& object) const;

    BulletTuning tuning_;
    std::vector<Body> bodies_;  // [0] never moves
    std::vector<Row> rows_;
    std::vector<Joint> joints_;
    std::vector<Contact> contacts_;
    std::vector<Push> pushes_;     // one a body
    std::vector<Island> islands_;  // by Body::island
    std::vector<int> jointOrder_;
    std::vector<int> contactOrder_;
    std::vector<int> islandOfTag_;  // -1: none yet
    btAlignedObjectArray<btSolverConstraint> scratch_;
};

}  // namespace lutka::physics
