#pragma once

#include <btBulletDynamicsCommon.h>

#include <span>
#include <vector>

#include "physics/bullet/bullet_world.hpp"
#include "physics/bullet/ragdoll_joint.hpp"
#include "physics/bullet/solver_rows.hpp"
#include "physics/bullet/warm_started.hpp"

namespace lutka::physics {

/// The rows of one constraint, as indices into SubstepRows.
struct SubstepJoint {
    int a = 0;
    int b = 0;
    int point = -1;        // into points; -1: none
    int friction = -1;     // into frictions; -1: none
    int firstAngular = 0;  // into angulars
    int angulars = 0;
    int firstGeneral = 0;  // into generals
    int generals = 0;
    btTypedConstraint* constraint = nullptr;
    RagdollJoint* ragdoll = nullptr;  // the constraint, where it is one of ours
    WarmStarted* warm = nullptr;      // null: all rows keep, from no impulse
};

/// Dolls and props that touch or are linked, which no other island moves in a substep.
struct SubstepIsland {
    int firstBody = 0;  // into bodies
    int bodies = 0;
    int firstLink = 0;  // into the solver's links
    int links = 0;
    int firstTouch = 0;  // into the solver's touches
    int touches = 0;
    int firstJoint = 0;  // into joints
    int joints = 0;
    int firstContact = 0;  // into contacts
    int contacts = 0;
    float gain = 0;  // see warmStart()
    float square = 0;
    float share = 0;
    float mass = 0;    // kg, of all bodies
    float motion = 0;  // twice the energy of their centres, J; both as of calm()

    // By the root mean square over the mass.
    [[nodiscard]] bool isSlowerThan(float speed) const { return motion < speed * speed * mass; }
};

/// What a substep solves: all bodies and islands, and the rows of the islands at hand only, in their order: so few that
/// they stay in the processor's nearest caches.
struct SubstepRows {
    static constexpr int kFixed = 0;  ///< Index of the body that never moves.

    std::vector<SolverBody> bodies;      ///< After the fixed one in the order of their islands.
    std::vector<SubstepIsland> islands;  ///< By SolverBody::island.
    std::vector<SubstepJoint> joints;
    std::vector<PointRows> points;
    std::vector<TurnFriction> frictions;
    std::vector<AngularRow> angulars;
    std::vector<GeneralRow> generals;
    std::vector<ContactRows> contacts;

    [[nodiscard]] SubstepIsland& islandOfPair(int a, int b) { return islands[bodies[a != kFixed ? a : b].island]; }
    [[nodiscard]] std::span<SolverBody> bodiesOf(const SubstepIsland& island) {
        return std::span(bodies).subspan(island.firstBody, island.bodies);
    }
};

/// Solves the rows of a substep's islands by sequential impulses. The rows must outlive it.
class SubstepSweeps {
  public:
    static constexpr std::size_t kTogether = 2;  ///< Islands solved in turn, at most.

    SubstepSweeps(const BulletTuning& tuning, SubstepRows& rows) : tuning_(tuning), rows_(rows) {}

    /// What lies nearly still is brought to rest. Call first for each island; `seconds` > 0.
    void calm(SubstepIsland& island, float seconds);
    /// Applies a share of the impulses that the rows come with.
    void warmStart(std::span<SubstepIsland> islands);
    /// Sweeps until the rows are right enough, in the pass that keeps or the one that mends.
    void iterate(std::span<const SubstepIsland> islands, bool mending);
    /// Gives contacts that bounce their speed back.
    void bounce();

  private:
    // An island that is being swept; both as solveJoint() returns them.
    struct Sweeping {
        const SubstepIsland* island = nullptr;
        float tolerance = 0;
        float residual = 0;
    };
    // Visits a joint's rows of every kind.
    template <class Visit>
    void forRows(const SubstepJoint& joint, const Visit& visit);
    void gatherPushes();
    void applyShares();
    // The squares of the speed by which rows were wrong, m²/s² (angular rows: of a point at an arm's length).
    float solveJoint(const SubstepJoint& joint, bool mending);
    float solveContact(ContactRows& contact, bool mending);
    void sweep(std::span<Sweeping> sweepings, bool mending, bool forth);

    BulletTuning tuning_;
    SubstepRows& rows_;
    std::vector<PushSum> pushes_;  // one a body
};

}  // namespace lutka::physics
