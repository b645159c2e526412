#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "core/aabb.hpp"
#include "core/task_pool.hpp"
#include "core/union_find.hpp"
#include "physics/crowd/batch.hpp"
#include "physics/crowd/chunked.hpp"
#include "physics/crowd/kernels.hpp"
#include "physics/crowd/narrowphase.hpp"
#include "physics/crowd/tuning.hpp"
#include "physics/world/world.hpp"

namespace lutka::physics::crowd {

/// What a contact carries from one step to the next: impulses of one substep.
struct CarriedPush {
    float normal = 0.0F;     ///< N s
    vec3 friction{0, 0, 0};  ///< N s, world axes.
    float approach = 0.0F;   ///< Of a contact between bodies, m/s: see PairContactLanes.
};
struct CarriedContact : CarriedPush {
    std::uint64_t key = 0;  ///< Which contact.
};

/// The same of a contact with static geometry, and what a report of it needs.
struct CarriedStatic {
    CarriedContact contact;
    vec3 roll{0, 0, 0};  ///< N m s
    int body = 0;
    vec3 local{0, 0, 0};  ///< Point of the core, body space.
    float radius = 0.0F;
    vec3 normal{0, 1, 0};
    float offset = 0.0F;  ///< The solid is normal · p <= offset.
};

/// A doll or a prop. Awake ones live in a lane of their group; sleeping ones here.
struct Doll {
    const RagdollProfile* profile = nullptr;  ///< Null for a prop.
    int group = 0;
    int batch = -1;  ///< Of the group; -1 while asleep.
    int lane = 0;
    int firstBody = 0;              ///< Number of its first body among all bodies of the world.
    int firstBox = 0;               ///< Into CrowdState::stepBoxes.
    int boxes = 0;                  ///< How many it has there.
    std::vector<BodyState> frozen;  ///< The bodies while asleep.
    float pace = 1.0F;              ///< See paceOf().
    float substepSeconds = 1.0F;    ///< Of the last substep: what it carries to the next step are impulses of it.
    float restSeconds = 0.0F;       ///< For how long it has been below the sleeping speeds.
    std::int64_t island = -1;       ///< Dolls that fell asleep together share a number; they wake together.
    bool touching = false;          ///< Whether anything held it in the last step.
    bool struckHard = false;        ///< Whether a fast prop may hit it in this step.
    int motors = 0;                 ///< How many of its joints have one.
    vec3 low{0, 0, 0};              ///< Bounds for the step as seen from the root: see Kernels::findBounds.
    vec3 high{0, 0, 0};
    vec3 rootVelocity{0, 0, 0};
    double way = 0.0;             ///< Metres that any of its bodies has moved at most, in sum since it was added,
    float reachesFarther = 0.0F;  ///< and that its bounds for the step reach beyond its bodies as they lie.
    CollisionFilter filter;
    bool removed = false;      ///< Its place waits for another with as many bodies.
    ContactReport::Side side;  ///< What the world calls it.
    std::vector<CarriedStatic> statics;

    [[nodiscard]] bool asleep() const { return batch < 0; }
};

/// Room for `count` and a little more: vectors double by themselves, which is much for what is large.
template <class T>
void makeRoom(std::vector<T>& items, std::size_t count) {
    if (items.capacity() < count) items.reserve(count + count / 8 + 4);
}

/// Empties `items` and has room for `count`, without much more than that: a heap has thrice the contacts while it
/// falls.
template <class T>
void renewRoom(std::vector<T>& items, std::size_t count) {
    items.clear();
    if (items.capacity() >= count && items.capacity() <= count + count / 2 + 64) return;
    items = std::vector<T>();  // given back first; `{}` would keep it
    makeRoom(items, count);
}

/// All dolls of one topology: awake ones fill the batches in order.
struct Group {
    Topology topology;
    std::vector<Batch> batches;
    int awake = 0;

    [[nodiscard]] int batchesInUse() const { return (awake + kLanes - 1) / kLanes; }
};

/// A contact of this step between two bodies.
struct PairTouch {
    int dollA = 0, dollB = 0;
    std::uint16_t bodyA = 0, bodyB = 0;
    std::uint8_t shapeA = 0, shapeB = 0;  ///< Which of the bodies' shapes.
    BodyTouch touch;                      ///< Its points in the bodies' spaces.
    CarriedContact carried;
};

using TouchList = Chunked<PairTouch, 512>;

/// The contacts between bodies that pressed at the end of the last step, by key.
class CarriedPairs {
  public:
    /// Forgets all, and has room for `count`.
    void renew(std::size_t count);
    /// Several threads may do this at the same time: which place a contact gets then depends on them, whether and where
    /// it is found does not.
    void add(const CarriedContact& contact);
    /// Null when there was no such contact.
    [[nodiscard]] const CarriedPush* find(std::uint64_t key) const;

  private:
    // Open addressing, a power of two; key 0 is empty. Most contacts are new and look at a key only.
    std::vector<std::uint64_t> keys_;
    std::vector<CarriedPush> pushes_;
};

/// A pull on a body.
struct DragRecord {
    int doll = 0;  ///< Into CrowdState::dolls.
    Drag drag;
    bool bounded = false;   ///< Whether its force reached the bound at the end of the last step.
    std::size_t index = 0;  ///< Of this step, into Batch::drags.
    vec3 before{0, 0, 0};   ///< m/s, of the point at the substep's start.
};

/// A motor in a joint of a doll that is no prop.
struct MotorRecord {
    int doll = 0;  ///< Into CrowdState::dolls.
    int constraint = 0;
    JointMotor motor;
    bool bounded = false;  ///< Whether its torque reached the bound at the end of the last step.
};

/// A frame that a body of a doll is led to.
struct TargetRecord {
    int doll = 0;  ///< Into CrowdState::dolls.
    int body = 0;
    BodyTarget target;
    std::optional<BodyTarget> followed;  ///< In the last step.
};

/// A force that acts throughout a step.
struct ForceRecord {
    int doll = 0;  ///< Into CrowdState::dolls.
    int body = 0;
    vec3 force{0, 0, 0};
    vec3 point{0, 0, 0};  ///< Body space.
};

/// The number of a static contact: geometry, body, which of its shapes, part of the shape. Never 0.
[[nodiscard]] constexpr std::uint64_t staticKey(int geometry, int body, int shape, int feature) {
    static_assert(RagdollProfile::kMostBodies <= 1 << 13 && BodyShape::kMostAdded < 4);
    return (static_cast<std::uint64_t>(geometry + 1) << 40U) | static_cast<std::uint64_t>(shape) << 38U |
           static_cast<std::uint64_t>(body) << 25U | static_cast<std::uint64_t>(feature);
}
[[nodiscard]] constexpr int geometryOfKey(std::uint64_t key) {
    return static_cast<int>(key >> 40U) - 1;
}

/// Which of its shapes' points a contact between bodies is, by its key.
[[nodiscard]] constexpr int indexOfKey(std::uint64_t key) {
    return static_cast<int>(key & 0xFU);
}

/// A contact between bodies, in short.
struct TouchBrief {
    int dollA = 0, dollB = 0;
    int bodyA = 0, bodyB = 0;  ///< Among all bodies of the world.
    bool presses = false;      ///< After the step: whether it did in its last substep. Before: or is likely to.
    bool isDeep = false;       ///< Whether its bodies lay more than millimetres in each other when the step began.
};

using BriefList = Chunked<TouchBrief, 2048>;

/// A part of a job's contacts between bodies: see partTouches().
struct PairPart {
    std::size_t firstTouch = 0;  ///< Into Job::touches.
    std::size_t touchCount = 0;
    PairsView view{};       ///< Its blocks.
    bool overlaps = false;  ///< Whether the mending of this substep has found any overlap.
};

/// A contact within a doll while that is mended exactly: see own_wedges.hpp.
struct OwnWedge {
    PairContactLanes* pair = nullptr;
    int pairLane = 0;
    const Batch* batch = nullptr;
    int lane = 0;  ///< Of the batch.
    int bodyA = 0, bodyB = 0;
    float separation = 0.0F;                         ///< Metres.
    float asked = 0.0F;                              ///< m/s that it is to part with at least.
    float inverseMassA = 0.0F, inverseMassB = 0.0F;  ///< 0 where something leads the body.
    vec3 push{0, 0, 0};  ///< N s, world, on A: what parts the two bodies, were they points and alone, with 1 m/s.
    vec3 armA{0, 0, 0}, armB{0, 0, 0};  ///< World.
};

/// Batches that touch each other, solved as one; jobs share nothing and can run at the same time.
struct Job {
    std::vector<Batch*> batches;
    std::vector<const Topology*> topologies;  ///< One a batch.
    std::vector<int> touches;                 ///< Into CrowdState::touches.
    std::vector<PairPart> parts;              ///< Of its contacts; those that are no neighbours share no body.
    std::size_t firstPart = 0;                ///< Among those of all jobs.
    std::size_t firstBlock = 0;               ///< Its pair contacts, in CrowdState::pairs.
    std::size_t blockCount = 0;
    std::vector<DragRecord*> drags;
    std::vector<const ForceRecord*> forces;
    std::vector<OwnWedge> wedges;  ///< Of this substep, while it is mended.
    int deepTouches = 0;           ///< How many of its contacts lie deep.
    int substeps = 0;              ///< Of this step.
    double dragWork = 0.0;
    double dragImpulse = 0.0;
    double motorWork = 0.0;  ///< And of forces.
};

/// Whether each phase of a job's substep is split over the threads; with fewer batches the hand-over costs more.
[[nodiscard]] inline bool isSplit(const Job& job) {
    return job.batches.size() >= 16;
}

/// An empty box meets nothing.
inline void writeBox(BoxLanes& boxes, int lane, const Aabb& bounds) {
    writeVector(boxes.low, lane, bounds.low);
    writeVector(boxes.high, lane, bounds.high);
}

/// A doll's place in the sweep along x.
struct Swept {
    Aabb bounds;  ///< World.
    int doll = 0;
};

/// Of a piece of the sweep: pairs of dolls that meet, and room to look for them.
struct SweptPairs {
    std::vector<std::pair<int, int>> pairs;
    std::vector<int> near;  ///< Places in the sweep.
};

/// Which bodies of two dolls may be near each other for some steps to come. Dolls of a heap that lie nearly still are
/// not looked through body by body in every step.
struct NearBodies {
    std::pair<int, int> dolls{-1, -1};
    bool holds = false;  ///< Whether `pairs` can be relied on while the dolls move little.
    double way = 0.0;    ///< Sum of both dolls' ways then.
    std::vector<std::array<std::uint8_t, 2>> pairs;
};

/// Of a piece of the pairs of dolls: what was found, and room to look for it.
struct PieceTouches {
    std::vector<PairTouch> touches;
    std::vector<BodyPair> near;
};

/// Which touches lie in the lanes of some blocks; -1 where a lane is empty.
using BlockTouches = std::vector<std::array<int, kLanes>>;

/// How many substeps a step of some length has: see substepsFor().
struct StepSubsteps {
    int rest = 1;   ///< Where hardly anything moves and nothing may fall asleep,
    int calm = 1;   ///< where nothing moves fast,
    int usual = 1;  ///< where things move as they do in a fall, and
    int most = 1;   ///< where a doll by itself is faster than that.
};

/// What the parts of a step work with; kept so that a step allocates nothing.
struct Scratch {
    std::vector<Swept> swept;
    std::vector<SweptPairs> sweptPairs;  ///< Of the pieces of the sweep.
    std::vector<int> firstOf, next;      ///< Places of a doll's pairs.
    UnionFind sets;
    std::vector<int> jobOf;                ///< One a representative of `sets`.
    std::vector<std::uint64_t> usedBy;     ///< One a body of the world, 0 between packings; see packTouches().
    std::vector<std::uint16_t> keys;       ///< One a touch of a job: see partTouches().
    std::vector<int> sorted;               ///< A job's touches.
    std::vector<std::size_t> placeOfList;  ///< Among the touches.
    std::vector<BlockTouches> blocksOf;    ///< Of each part of all jobs.
    std::vector<char> restless;            ///< One a doll.
    std::vector<std::size_t> placeOfNear;  ///< One a NearBodies that is kept: see keepNearBodies().
    std::vector<int> needing;              ///< Dolls of a job by the number of substeps that they need.
    std::vector<SubstepParams> paramsFor;  ///< By the number of substeps that a step has.
};

/// Everything in a crowd world. The steps of the simulation are free functions over it, each in its own file.
struct CrowdState {
    CrowdState(const WorldSettings& given, const CrowdTuning& tuned);

    WorldSettings settings;
    CrowdTuning tuning;
    const Kernels* kernels;
    TaskPool pool;

    std::vector<PlacedStatic> statics;
    std::vector<StaticId> staticIds;  ///< One a static.
    std::vector<std::unique_ptr<Group>> groups;
    std::vector<Doll> dolls;
    std::vector<int> ragdolls;              ///< In the order of the world's dolls, into `dolls`.
    std::vector<int> props;                 ///< In the order of the world's props, into `dolls`.
    std::vector<DynamicProp> propSettings;  ///< One a prop, as it was added.
    std::vector<DragRecord> drags;          ///< In the order of the world's drags.
    double dragWork = 0.0;
    StepSubsteps stepSubsteps;          ///< Of this step.
    std::vector<MotorRecord> motors;    ///< By doll and constraint.
    std::size_t nextMotor = 0;          ///< After the one that was set last.
    std::vector<TargetRecord> targets;  ///< By doll and body.
    std::vector<ForceRecord> forces;    ///< Of the coming step.
    double motorWork = 0.0;             ///< And of forces.
    double dragImpulse = 0.0;           ///< N s, see WorldView::dragImpulse().
    std::vector<ContactReport> reports;
    int bodyTotal = 0;
    int boxTotal = 0;  ///< BoxLanes.
    std::int64_t nextIsland = 0;

    std::vector<Batch*> active;                       ///< Batches in use in this step.
    std::vector<Group*> activeGroup;                  ///< One an active batch.
    std::vector<std::vector<PairTouch>> selfTouches;  ///< One an active batch.
    std::vector<StepBody> stepBodies;                 ///< One a body of the world; those of dolls near others are set.
    std::vector<BodyMotion> motions;                  ///< One a body of the world; those with pair contacts are set.
    std::vector<BodyFrame> frames;                    ///< Likewise.
    std::vector<BoxLanes> stepBoxes;                  ///< From Doll::firstBox on, of the same dolls.
    std::vector<char> isNear;                         ///< One a doll: whether its bounds meet another's.
    std::vector<PieceTouches> dollTouches;            ///< Of the pieces of `dollPairs` that are at work.
    std::vector<int> sweep;                           ///< Dolls by the low end of their bounds along x,
    std::vector<BoxLanes> sweptBoxes;                 ///< and these bounds.
    std::vector<std::pair<int, int>> dollPairs;
    std::vector<NearBodies> nearBodies;  ///< One each.
    TouchList touches;                   ///< Of this step; after it with its impulses.
    Chunked<PairContactLanes, kPairChunk> pairs;
    BriefList briefs;                           ///< One a touch.
    std::vector<char> isPaired;                 ///< One a body of the world: whether a contact of this step pushes it.
    std::vector<std::uint8_t> binOf;            ///< One a body of the world: see partTouches().
    std::vector<PairContactLanes*> pairChunks;  ///< Where their pieces are.
    BlockTouches touchOfLane;                   ///< One a pair block.
    std::vector<Wide> impulseSums;              ///< One a pair block, of a step's substeps; for reports.
    std::vector<int> liveBlocks;                ///< Two a pair block: room for the lists of PairsView.
    CarriedPairs carried;
    std::vector<Job> jobs;
    std::size_t jobCount = 0;
    Scratch scratch;

    /// TaskPool::parallelFor() by reference: a copy of the work's captures would be on the heap.
    template <class Work>
    void inParallel(std::size_t count, std::size_t grain, const Work& work) const {
        pool.parallelFor(count, grain, std::cref(work));
    }
    [[nodiscard]] Group& groupOf(const Doll& doll) { return *groups[doll.group]; }
    [[nodiscard]] const Group& groupOf(const Doll& doll) const { return *groups[doll.group]; }
    [[nodiscard]] Batch& batchOf(const Doll& doll) { return groupOf(doll).batches[doll.batch]; }
    [[nodiscard]] const Batch& batchOf(const Doll& doll) const { return groupOf(doll).batches[doll.batch]; }
};

[[nodiscard]] inline PairBodies pairBodiesOf(CrowdState& state) {
    return {state.motions.data(), state.frames.data()};
}

/// Adds a doll or prop, awake. Returns its index in CrowdState::dolls.
int addDoll(CrowdState& state, Topology topology, const RagdollProfile* profile, std::span<const BodyState> bodies);

[[nodiscard]] BodyState bodyState(const CrowdState& state, const Doll& doll, int body);
[[nodiscard]] PlacedShape placedShape(const CrowdState& state, const Doll& doll, int body, int shape = 0);

/// Gives a sleeping doll a lane. `wakeIsland` wakes those that fell asleep with it as well.
void wake(CrowdState& state, int doll);
void wakeIsland(CrowdState& state, int doll);
/// Takes a doll out of its lane and puts it to rest, with bounds of its own.
void putToSleep(CrowdState& state, int doll);

/// Takes a doll or prop out: wakes what slept with it, forgets its contacts and motors.
void removeDoll(CrowdState& state, int doll);

/// Lists the batches in use and makes the lanes without a doll repeat lane 0.
void gatherActive(CrowdState& state);

}  // namespace lutka::physics::crowd
