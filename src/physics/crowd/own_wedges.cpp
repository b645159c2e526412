#include "physics/crowd/own_wedges.hpp"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <tuple>

#include "physics/crowd/contact_rules.hpp"

namespace lutka::physics::crowd {
namespace {

// Of a doll, the deepest.
constexpr int kMostWedges = 6;

// m/s: another own body farther off than what this takes a body to in a substep is not met by mending.
constexpr float kMendNears = 2.0F;

// Those of a doll and what they do to each other.
struct DollWedges {
    std::array<const OwnWedge*, kMostWedges> wedges{};
    int count = 0;
    std::array<float, kMostWedges> start{};                        // m/s that each parts with, without any push
    std::array<std::array<float, kMostWedges>, kMostWedges> by{};  // [i][k]: and what a push of one at k adds at i
    std::array<float, kMostWedges> push{};
};
using LaneWedges = std::array<DollWedges, kLanes>;

// Velocities of a batch's bodies before an attempt.
struct Before {
    Wide3 velocity, angular;
};

vec3 times(const WideSymmetric& m, int lane, const vec3& v) {
    const float xy = m.xy.lane[lane];
    const float xz = m.xz.lane[lane];
    const float yz = m.yz.lane[lane];
    return {m.xx.lane[lane] * v.x + xy * v.y + xz * v.z, xy * v.x + m.yy.lane[lane] * v.y + yz * v.z,
            xz * v.x + yz * v.y + m.zz.lane[lane] * v.z};
}

void addTo(Wide3& to, int lane, const vec3& v) {
    writeVector(to, lane, readVector(to, lane) + v);
}

// It is asked of a contact what mendPairs() asks, but for its eagerness: all that hangs on the bodies is known here.
OwnWedge makeWedge(CrowdState& state, PairContactLanes& pair, int lane, const PairTouch& touch,
                   const SubstepParams& params) {
    const Doll& doll = state.dolls[touch.dollA];
    const float massA = pair.inverseMassA.lane[lane];
    const float massB = pair.inverseMassB.lane[lane];
    return {&pair,
            lane,
            &state.batchOf(doll),
            doll.lane,
            touch.bodyA,
            touch.bodyB,
            pair.separation.lane[lane],
            mendSpeed(pair.separation.lane[lane], params.ownPushSpeed, params.mendHaste, params),
            massA,
            massB,
            readVector(pair.normal, lane) / (massA + massB),
            readVector(pair.armA, lane),
            readVector(pair.armB, lane)};
}

void pushAt(Batch& batch, int lane, const OwnWedge& wedge, float size) {
    const auto give = [&](int body, float inverseMass, const vec3& arm, const vec3& impulse) {
        if (inverseMass == 0.0F) return;  // led along
        BodyLanes& lanes = batch.bodies[body];
        addTo(lanes.velocity, lane, impulse * inverseMass);
        addTo(lanes.angular, lane, times(lanes.inverseInertia, lane, glm::cross(arm, impulse)));
    };
    give(wedge.bodyA, wedge.inverseMassA, wedge.armA, wedge.push * size);
    give(wedge.bodyB, wedge.inverseMassB, wedge.armB, wedge.push * -size);
}

// m/s
float partingAt(const Batch& batch, int lane, const OwnWedge& wedge) {
    const auto at = [&](int body, const vec3& arm) {
        return readVector(batch.bodies[body].velocity, lane) +
               glm::cross(readVector(batch.bodies[body].angular, lane), arm);
    };
    return glm::dot(glm::normalize(wedge.push), at(wedge.bodyA, wedge.armA) - at(wedge.bodyB, wedge.armB));
}

// Projected Gauss-Seidel: pushes of nothing or more with which each contact parts at least as fast as it is to.
void findPushes(DollWedges& doll, const SubstepParams& params) {
    constexpr int kSweeps = 60;
    constexpr float kStuck = 1e-6F;
    // What is held fast would be pushed ever harder.
    const float most = params.ownMass * params.ownPushSpeed * params.mendHaste;
    doll.push.fill(0.0F);
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
        for (int i = 0; i < doll.count; ++i) {
            float off = doll.start[i] - doll.wedges[i]->asked;
            for (int k = 0; k < doll.count; ++k)
                off += doll.by[i][k] * doll.push[k];
            if (doll.by[i][i] > kStuck) doll.push[i] = std::clamp(doll.push[i] - off / doll.by[i][i], 0.0F, most);
        }
    }
}

// Passes until nothing is run through, each after `prepare()`. Where that is not reached nothing is mended.
template <class Prepare>
void mendInPasses(const Kernels& kernels, const BatchView& view, const SubstepParams& params, unsigned firmly,
                  const Prepare& prepare) {
    unsigned unsolved = 0;
    for (int left = kMendPasses; left > 0; --left) {
        prepare();
        unsolved = kernels.mendOnce(view, params, firmly, left > 1 ? MendPass::more : MendPass::last);
        if (unsolved == 0) return;
    }
    kernels.mendNot(view, params, unsolved);
}

// One batch's, from the velocities that pair contacts have left.
class BatchWedges {
  public:
    BatchWedges(const CrowdState& state, Batch& batch, const Topology& topology, const SubstepParams& params)
        : kernels_(*state.kernels), batch_(batch), params_(params), view_(batch.view(topology)) {}

    void mend(LaneWedges& lanes) {
        kernels_.takeMotions(view_);
        thread_local std::vector<Before> before;
        before.resize(batch_.bodies.size());
        for (std::size_t b = 0; b < before.size(); ++b)
            before[b] = {batch_.bodies[b].velocity, batch_.bodies[b].angular};
        unsigned firmly = 0;
        for (int lane = 0; lane < kLanes; ++lane)
            firmly |= (lanes[lane].count > 0 ? 1U : 0U) << static_cast<unsigned>(lane);
        mendInPasses(kernels_, view_, params_, firmly, [&] {
            probe(lanes, before, firmly);
            restore(before);
            for (int lane = 0; lane < kLanes; ++lane) {
                DollWedges& doll = lanes[lane];
                findPushes(doll, params_);
                for (int i = 0; i < doll.count; ++i)
                    pushAt(batch_, lane, *doll.wedges[i], doll.push[i]);
            }
        });
    }

  private:
    void restore(const std::vector<Before>& before) {
        for (std::size_t b = 0; b < before.size(); ++b) {
            batch_.bodies[b].velocity = before[b].velocity;
            batch_.bodies[b].angular = before[b].angular;
        }
    }

    // What a push at each does to all of them, with the rows that hold now.
    void probe(LaneWedges& lanes, const std::vector<Before>& before, unsigned firmly) {
        const auto isLonger = [](const DollWedges& a, const DollWedges& b) { return a.count < b.count; };
        const int most = std::max_element(lanes.begin(), lanes.end(), isLonger)->count;
        constexpr int kNone = -1;
        for (int pushed = kNone; pushed < most; ++pushed) {
            restore(before);
            for (int lane = 0; pushed != kNone && lane < kLanes; ++lane)
                if (pushed < lanes[lane].count) pushAt(batch_, lane, *lanes[lane].wedges[pushed], 1.0F);
            kernels_.mendOnce(view_, params_, firmly, MendPass::probe);
            for (int lane = 0; lane < kLanes; ++lane) {
                DollWedges& doll = lanes[lane];
                for (int i = 0; i < doll.count; ++i) {
                    const float speed = partingAt(batch_, lane, *doll.wedges[i]);
                    if (pushed == kNone)
                        doll.start[i] = speed;
                    else
                        doll.by[i][pushed] = speed - doll.start[i];
                }
            }
        }
    }

    const Kernels& kernels_;
    Batch& batch_;
    const SubstepParams& params_;
    BatchView view_;
};

}  // namespace

void findWedges(CrowdState& state, Job& job, const SubstepParams& params) {
    job.wedges.clear();
    const auto isWedged = [](const PairPart& part) { return part.view.wedges != 0; };
    if (params.isHeap != 0 || std::none_of(job.parts.begin(), job.parts.end(), isWedged)) return;
    std::vector<OwnWedge>& wedges = job.wedges;
    for (const PairPart& part : job.parts) {
        for (int i = 0; i < part.view.liveCount; ++i) {
            const int block = part.view.live[i];
            PairContactLanes& pair = state.pairs[static_cast<std::size_t>(block)];
            for (int lane = 0; lane < kLanes; ++lane) {
                const bool isNear = pair.separation.lane[lane] < kMendNears * params.dt;
                const bool yields = pair.inverseMassA.lane[lane] + pair.inverseMassB.lane[lane] > 0.0F;
                if (pair.kind.lane[lane] == PairKind::own && isNear && yields)
                    wedges.push_back(
                        makeWedge(state, pair, lane, state.touches[state.touchOfLane[block][lane]], params));
            }
        }
    }
    // Which of a doll's come first must not depend on where others have been packed.
    std::sort(wedges.begin(), wedges.end(), [](const OwnWedge& a, const OwnWedge& b) {
        return std::tie(a.separation, a.bodyA, a.bodyB, a.armA.x, a.armA.y, a.armA.z) <
               std::tie(b.separation, b.bodyA, b.bodyB, b.armA.x, b.armA.y, b.armA.z);
    });
    auto end = wedges.begin();
    for (const OwnWedge& wedge : wedges) {
        const auto isOfSame = [&](const OwnWedge& other) {
            return other.batch == wedge.batch && other.lane == wedge.lane;
        };
        const auto count = std::count_if(wedges.begin(), end, isOfSame);
        if (count == kMostWedges || (count == 0 && wedge.separation > -params.wedgeDepth)) continue;
        wedge.pair->kind.lane[wedge.pairLane] = PairKind::wedged;
        *end++ = wedge;
    }
    wedges.erase(end, wedges.end());
}

void mendDolls(CrowdState& state, const Job& job, std::size_t batch, const SubstepParams& params, bool pushed) {
    LaneWedges lanes;
    bool hasAny = false;
    Batch& of = *job.batches[batch];
    for (const OwnWedge& wedge : job.wedges) {
        if (wedge.batch != &of) continue;
        hasAny = true;
        for (int lane = 0; lane < kLanes; ++lane)  // those without a doll repeat the first
            if ((lane < of.used ? lane : 0) == wedge.lane) lanes[lane].wedges[lanes[lane].count++] = &wedge;
    }
    const Topology& topology = *job.topologies[batch];
    if (hasAny) return BatchWedges(state, of, topology, params).mend(lanes);
    const Kernels& kernels = *state.kernels;
    const BatchView view = of.view(topology);
    if (!pushed && kernels.needsMending(view, params) == 0) return;
    if (pushed) kernels.takeMotions(view);
    mendInPasses(kernels, view, params, 0, [] {});
}

void endWedges(Job& job) {
    for (const OwnWedge& wedge : job.wedges)
        wedge.pair->kind.lane[wedge.pairLane] = PairKind::own;
    job.wedges.clear();
}

}  // namespace lutka::physics::crowd
