#include "physics/crowd/packing.hpp"

#include <bit>

#include "physics/collision/friction.hpp"
#include "physics/crowd/jobs.hpp"
#include "physics/crowd/target.hpp"

namespace lutka::physics::crowd {
namespace {

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
    if (!follows) pair.follows &= ~(1U << static_cast<unsigned>(lane));
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
    if (isJointed(a) && isJointed(b))
        pair.kind.lane[lane] = touch.dollA != touch.dollB ? PairKind::dolls
                               : a.motors > 0             ? PairKind::driven
                                                          : PairKind::own;
    const auto onAxisY = [](const vec3& local) { return local.x == 0.0F && local.z == 0.0F; };
    if (!onAxisY(touch.touch.localA) || !onAxisY(touch.touch.localB)) pair.onAxisY = 0;
}

// A block without contacts, as far as fillLane() and the first substep do not set it: most of it is written when it is
// first needed.
void emptyBlock(PairContactLanes& pair) {
    pair.onAxisY = 1;
    pair.follows = kAllLanes;
    pair.ready = 0;
    pair.kind = pair.load = pair.normalMass = pair.tangentImpulse[0] = pair.tangentImpulse[1] = {};
}

// Gives each contact of a part the first open block that has room and neither of its bodies: a greedy colouring whose
// colours hold at most eight edges. When no block of the window will do, a new window is opened. Blocks are filled
// afterwards, one by one: a block is large, and filling 64 in turn would push them all out of the nearest cache.
class Packer {
  public:
    Packer(CrowdState& state, std::span<const int> touches, BlockTouches& blocks)
        : briefs_(state.briefs), touches_(touches), blocks_(blocks), usedBy_(state.scratch.usedBy) {}

    void pack() {
        blocks_.clear();
        for (std::size_t i = 0; i < touches_.size(); ++i) {
            if (place(touches_[i])) continue;
            forget(i);
            openWindow();
            place(touches_[i]);
        }
        forget(touches_.size());
    }

  private:
    // Leaves the table clean of the window's contacts, of which `end` is the one after the last.
    void forget(std::size_t end) {
        for (; placed_ < end; ++placed_) {
            const TouchBrief& brief = briefs_[touches_[placed_]];
            usedBy_[brief.bodyA] = usedBy_[brief.bodyB] = 0;
        }
    }

    void openWindow() {
        first_ = blocks_.size();
        full_ = 0;
    }

    // False: no block of the window will do.
    bool place(int index) {
        const TouchBrief& brief = briefs_[index];
        std::uint64_t& usedA = usedBy_[brief.bodyA];
        std::uint64_t& usedB = usedBy_[brief.bodyB];
        const std::uint64_t taken = usedA | usedB | full_;
        if (~taken == 0) return false;
        const int bit = std::countr_one(taken);
        const std::size_t block = first_ + static_cast<std::size_t>(bit);
        if (blocks_.size() == block) {
            makeRoom(blocks_, block + 1);
            blocks_.emplace_back().fill(-1);
            filled_[bit] = 0;
        }
        blocks_[block][filled_[bit]++] = index;
        const std::uint64_t mask = std::uint64_t{1} << static_cast<unsigned>(bit);
        usedA |= mask;
        usedB |= mask;
        if (filled_[bit] == kLanes) full_ |= mask;
        return true;
    }

    const BriefList& briefs_;
    std::span<const int> touches_;
    BlockTouches& blocks_;
    std::vector<std::uint64_t>& usedBy_;  // one a body of the world: the blocks of the window that have it
    std::size_t placed_ = 0;              // the window's first contact
    std::size_t first_ = 0;               // the window's first block
    std::uint64_t full_ = 0;
    std::array<int, kWindow> filled_{};
};

void fillBlock(CrowdState& state, std::size_t block) {
    fetchTouches(state, block + 1);
    PairContactLanes& pair = state.pairs[block];
    emptyBlock(pair);
    for (int lane = 0; lane < kLanes; ++lane) {
        const int index = state.touchOfLane[block][lane];
        fillLane(state, pair, lane, state.touches[index >= 0 ? index : state.touchOfLane[block][0]]);
        if (index >= 0) continue;
        pair.friction.lane[lane] = 0.0F;
        pair.kind.lane[lane] = PairKind::other;
    }
}

// One for each part of all jobs.
void packParts(CrowdState& state) {
    state.scratch.usedBy.resize(static_cast<std::size_t>(state.bodyTotal), 0);
    std::vector<BlockTouches>& blocksOf = state.scratch.blocksOf;
    std::size_t parts = 0;
    for (std::size_t i = 0; i < state.jobCount; ++i) {
        state.jobs[i].firstPart = parts;
        parts += state.jobs[i].parts.size();
    }
    if (blocksOf.size() < parts) blocksOf.resize(parts);
    forJobs(state, [&](Job& job) {
        forParts(state, job, [&](PairPart& part) {
            const std::span touches = std::span<const int>(job.touches).subspan(part.firstTouch, part.touchCount);
            const auto number = static_cast<std::size_t>(&part - job.parts.data());
            Packer(state, touches, blocksOf[job.firstPart + number]).pack();
        });
    });
}

// All parts' blocks one after the other.
void joinBlocks(CrowdState& state) {
    state.touchOfLane.clear();
    for (std::size_t i = 0; i < state.jobCount; ++i) {
        Job& job = state.jobs[i];
        job.firstBlock = state.touchOfLane.size();
        for (std::size_t k = 0; k < job.parts.size(); ++k) {
            const BlockTouches& blocks = state.scratch.blocksOf[job.firstPart + k];
            job.parts[k].view.first = static_cast<int>(state.touchOfLane.size());
            job.parts[k].view.count = static_cast<int>(blocks.size());
            makeRoom(state.touchOfLane, state.touchOfLane.size() + blocks.size());
            state.touchOfLane.insert(state.touchOfLane.end(), blocks.begin(), blocks.end());
        }
        job.blockCount = state.touchOfLane.size() - job.firstBlock;
    }
}

}  // namespace

void packTouches(CrowdState& state) {
    packParts(state);
    joinBlocks(state);
    const std::size_t count = state.touchOfLane.size();
    state.pairs.clear();
    state.pairs.resize(count);
    state.pairChunks.clear();
    for (std::size_t i = 0; i < count; i += kPairChunk)
        state.pairChunks.push_back(&state.pairs[i]);
    state.liveBlocks.resize(2 * count);
    for (std::size_t i = 0; i < state.jobCount; ++i) {
        for (PairPart& part : state.jobs[i].parts) {
            part.view.chunks = state.pairChunks.data();
            part.view.bodies = pairBodiesOf(state);
            part.view.live = state.liveBlocks.data() + 2 * static_cast<std::size_t>(part.view.first);
            part.view.changed = part.view.live + part.view.count;
        }
    }
    state.inParallel(count, 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t block = begin; block < end; ++block)
            fillBlock(state, block);
    });
}

}  // namespace lutka::physics::crowd
