#include "physics/crowd/jobs.hpp"

#include <algorithm>
#include <bit>

#include "physics/crowd/substeps.hpp"
#include "physics/crowd/target.hpp"

namespace lutka::physics::crowd {
namespace {

// Metres: contacts nearer than this are likely to press.
constexpr float kNear = 0.005F;
// The window of blocks that are open at a time; one bit each.
constexpr int kWindow = 64;

void fillLane(CrowdState& state, PairContactLanes& pair, int lane, const PairTouch& touch) {
    constexpr float kFriction = kBodyFriction * kBodyFriction;
    const Doll& a = state.dolls[touch.dollA];
    const Doll& b = state.dolls[touch.dollB];
    pair.bodyA[lane] = a.firstBody + touch.bodyA;
    pair.bodyB[lane] = b.firstBody + touch.bodyB;
    writeVector(pair.localA, lane, touch.touch.localA);
    writeVector(pair.localB, lane, touch.touch.localB);
    const PrimitiveShape& shapeA = state.groupOf(a).topology.shapeOf(touch.bodyA, touch.shapeA);
    const PrimitiveShape& shapeB = state.groupOf(b).topology.shapeOf(touch.bodyB, touch.shapeB);
    // Only a core about its body's centre can be followed.
    const bool follows = !shapeA.isAngular() && !shapeB.isAngular() && touch.shapeA == 0 && touch.shapeB == 0;
    if (!follows) pair.follows = 0;
    pair.radius.lane[lane] = touch.touch.radius;
    writeVector(pair.normal, lane, touch.touch.normal);
    const auto inverseMassOf = [&](const Doll& doll, int body) {
        return isKinematic(state.batchOf(doll), body, doll.lane)
                   ? 0.0F
                   : state.groupOf(doll).topology.bodies[body].inverseMass;
    };
    pair.inverseMassA.lane[lane] = inverseMassOf(a, touch.bodyA);
    pair.inverseMassB.lane[lane] = inverseMassOf(b, touch.bodyB);
    pair.friction.lane[lane] = kFriction;
    pair.normalImpulse.lane[lane] = touch.carried.normal;
    pair.approach.lane[lane] = touch.carried.approach;
    writeVector(pair.tangent, lane, touch.carried.friction);
    const auto isJointed = [&](const Doll& doll) { return !state.groupOf(doll).topology.joints.empty(); };
    if (isJointed(a) && isJointed(b)) pair.kind.lane[lane] = touch.dollA != touch.dollB ? 2.0F : 1.0F;
    const auto onAxisY = [](const vec3& local) { return local.x == 0.0F && local.z == 0.0F; };
    if (!onAxisY(touch.touch.localA) || !onAxisY(touch.touch.localB)) pair.onAxisY = 0;
}

// A block without contacts.
void emptyBlock(PairContactLanes& pair) {
    pair = {};
    pair.onAxisY = pair.follows = 1;
}

// Gives each contact the first open block that has room and neither of its bodies: a greedy colouring whose colours
// hold at most eight edges. When no block of the window will do, a new window is opened. Blocks are filled afterwards,
// one by one: a block is large, and filling 64 in turn would push them all out of the nearest cache.
class Packer {
  public:
    explicit Packer(CrowdState& state) : state_(state), usedBy_(state.scratch.usedBy) {
        usedBy_.resize(static_cast<std::size_t>(state.bodyTotal), 0);
    }

    void pack() {
        touchOfLane_.clear();
        for (std::size_t i = 0; i < state_.jobCount; ++i) {
            state_.jobs[i].firstBlock = touchOfLane_.size();
            placeAll(state_.jobs[i]);
            state_.jobs[i].blockCount = touchOfLane_.size() - state_.jobs[i].firstBlock;
        }
        const std::size_t count = touchOfLane_.size();
        state_.pairs.clear();
        state_.pairs.resize(count);
        state_.pairChunks.clear();
        for (std::size_t i = 0; i < count; i += kPairChunk)
            state_.pairChunks.push_back(&state_.pairs[i]);
        state_.liveBlocks.resize(2 * count);
        state_.inParallel(count, 64, [&](std::size_t begin, std::size_t end) {
            for (std::size_t block = begin; block < end; ++block)
                fill(block);
        });
    }

  private:
    void placeAll(Job& job) {
        openWindow();
        putPressingFirst(job.touches);
        for (std::size_t i = 0; i < job.touches.size(); ++i) {
            if (place(job.touches[i])) continue;
            forget(job, i);
            openWindow();
            place(job.touches[i]);
        }
        forget(job, job.touches.size());
    }

    // What will hardly press shares blocks, which are left early. std::stable_partition would allocate.
    void putPressingFirst(std::vector<int>& touches) {
        std::vector<int>& later = state_.scratch.later;
        later.clear();
        std::size_t to = 0;
        for (const int index : touches) {
            const PairTouch& touch = state_.touches[index];
            const bool presses = touch.carried.normal > 0.0F || touch.touch.separation < kNear;
            if (presses)
                touches[to++] = index;
            else
                later.push_back(index);
        }
        std::copy(later.begin(), later.end(), touches.begin() + static_cast<std::ptrdiff_t>(to));
    }

    std::uint64_t& used(int doll, int body) { return usedBy_[state_.dolls[doll].firstBody + body]; }

    // Leaves the table clean of the window's contacts, of which `end` is the one after the last.
    void forget(const Job& job, std::size_t end) {
        for (; placed_ < end; ++placed_) {
            const PairTouch& touch = state_.touches[job.touches[placed_]];
            used(touch.dollA, touch.bodyA) = used(touch.dollB, touch.bodyB) = 0;
        }
        if (end == job.touches.size()) placed_ = 0;
    }

    void openWindow() {
        first_ = touchOfLane_.size();
        full_ = 0;
    }

    // False: no block of the window will do.
    bool place(int index) {
        const PairTouch& touch = state_.touches[index];
        std::uint64_t& usedA = used(touch.dollA, touch.bodyA);
        std::uint64_t& usedB = used(touch.dollB, touch.bodyB);
        const std::uint64_t taken = usedA | usedB | full_;
        if (~taken == 0) return false;
        const int bit = std::countr_one(taken);
        const std::size_t block = first_ + static_cast<std::size_t>(bit);
        if (touchOfLane_.size() == block) {
            touchOfLane_.emplace_back().fill(-1);
            filled_[bit] = 0;
        }
        touchOfLane_[block][filled_[bit]++] = index;
        const std::uint64_t mask = std::uint64_t{1} << static_cast<unsigned>(bit);
        usedA |= mask;
        usedB |= mask;
        if (filled_[bit] == kLanes) full_ |= mask;
        return true;
    }

    void fill(std::size_t block) {
        PairContactLanes& pair = state_.pairs[block];
        emptyBlock(pair);
        for (int lane = 0; lane < kLanes; ++lane) {
            const int index = touchOfLane_[block][lane];
            fillLane(state_, pair, lane, state_.touches[index >= 0 ? index : touchOfLane_[block][0]]);
            if (index < 0) pair.friction.lane[lane] = pair.kind.lane[lane] = 0.0F;
        }
    }

    CrowdState& state_;
    std::vector<std::array<int, kLanes>>& touchOfLane_ = state_.touchOfLane;
    std::vector<std::uint64_t>& usedBy_;  // one a body of the world: the blocks of the window that have it
    std::size_t placed_ = 0;              // the window's first contact
    std::size_t first_ = 0;               // the window's first block
    std::uint64_t full_ = 0;
    std::array<int, kWindow> filled_{};
};

void assignBatches(CrowdState& state) {
    for (std::size_t i = 0; i < state.active.size(); ++i)
        state.active[i]->job = static_cast<int>(i);
    UnionFind& sets = state.scratch.sets;
    sets.reset(state.active.size());
    for (const PairTouch& touch : state.touches)
        sets.join(state.batchOf(state.dolls[touch.dollA]).job, state.batchOf(state.dolls[touch.dollB]).job);
    std::vector<int>& jobOf = state.scratch.jobOf;
    jobOf.assign(state.active.size(), -1);
    state.jobCount = 0;
    for (std::size_t i = 0; i < state.active.size(); ++i) {
        const int root = sets.find(static_cast<int>(i));
        if (jobOf[root] < 0) {
            jobOf[root] = static_cast<int>(state.jobCount++);
            if (state.jobs.size() < state.jobCount) state.jobs.emplace_back();
            Job& fresh = state.jobs[jobOf[root]];
            fresh.batches.clear();
            fresh.topologies.clear();
            fresh.touches.clear();
            fresh.drags.clear();
            fresh.forces.clear();
        }
        Job& job = state.jobs[jobOf[root]];
        job.batches.push_back(state.active[i]);
        job.topologies.push_back(&state.activeGroup[i]->topology);
    }
    for (std::size_t i = 0; i < state.active.size(); ++i)
        state.active[i]->job = jobOf[sets.find(static_cast<int>(i))];
}

// Which bodies of each batch pair contacts push, and where they are kept meanwhile.
void findPaired(CrowdState& state) {
    state.motions.resize(static_cast<std::size_t>(state.bodyTotal));
    state.frames.resize(static_cast<std::size_t>(state.bodyTotal));
    for (Batch* batch : state.active) {
        batch->paired.clear();
        batch->isPaired.assign(batch->bodies.size(), 0);
        batch->pairBodies = pairBodiesOf(state);
        for (int lane = 0; lane < kLanes; ++lane)
            batch->firstBody[lane] = state.dolls[batch->doll[lane < batch->used ? lane : 0]].firstBody;
    }
    const auto add = [&](int doll, int body) { state.batchOf(state.dolls[doll]).isPaired[body] = 1; };
    for (const PairTouch& touch : state.touches) {
        add(touch.dollA, touch.bodyA);
        add(touch.dollB, touch.bodyB);
    }
    for (Batch* batch : state.active)
        for (std::size_t body = 0; body < batch->isPaired.size(); ++body)
            if (batch->isPaired[body] != 0) batch->paired.push_back(static_cast<int>(body));
}

}  // namespace

void makeJobs(CrowdState& state) {
    assignBatches(state);
    findPaired(state);
    for (std::size_t i = 0; i < state.touches.size(); ++i)
        state.jobs[state.batchOf(state.dolls[state.touches[i].dollA]).job].touches.push_back(static_cast<int>(i));
    for (DragRecord& record : state.drags) {
        const Doll& doll = state.dolls[record.doll];
        state.jobs[state.batchOf(doll).job].drags.push_back(&record);
    }
    const auto jobOf = [&](int doll) -> Job& { return state.jobs[state.batchOf(state.dolls[doll]).job]; };
    for (const ForceRecord& record : state.forces)
        jobOf(record.doll).forces.push_back(&record);
    for (std::size_t i = 0; i < state.jobCount; ++i)
        setSubsteps(state, state.jobs[i]);
    // A muscle or pull at its bound works against what may give way at once, however calm the doll is yet.
    for (const MotorRecord& record : state.motors)
        if (record.bounded && !state.dolls[record.doll].asleep()) jobOf(record.doll).substeps = state.tuning.substeps;
    for (const DragRecord& record : state.drags)
        if (record.bounded) jobOf(record.doll).substeps = state.tuning.substeps;
    Packer(state).pack();
}

}  // namespace lutka::physics::crowd
