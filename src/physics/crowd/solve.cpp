#include "physics/crowd/solve.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>

#include "physics/crowd/bounds.hpp"
#include "physics/crowd/contact_rules.hpp"
#include "physics/crowd/drag.hpp"
#include "physics/crowd/force.hpp"
#include "physics/crowd/jobs.hpp"
#include "physics/crowd/motor.hpp"
#include "physics/crowd/moved_contacts.hpp"
#include "physics/crowd/own_wedges.hpp"
#include "physics/crowd/packing.hpp"
#include "physics/crowd/reports.hpp"
#include "physics/crowd/static_contacts.hpp"
#include "physics/crowd/substeps.hpp"
#include "physics/crowd/target.hpp"

namespace lutka::physics::crowd {
namespace {

SubstepParams paramsOf(const CrowdState& state, float dt) {
    const CrowdTuning& tuning = state.tuning;
    SubstepParams params{};
    static_cast<SubstepTuning&>(params) = static_cast<const SubstepTuning&>(tuning);
    params.dt = dt;
    params.inverseDt = 1.0F / dt;
    for (int i = 0; i < 3; ++i)
        params.gravity[i] = state.settings.gravity[i];
    params.linearDamping = std::exp(-tuning.linearDamping * dt);
    params.angularDamping = std::exp(-tuning.angularDamping * dt);
    params.jointRate = tuning.jointErp / dt;
    params.limitRate = tuning.limitErp / dt;
    params.contactRate = tuning.contactErp / dt;
    return params;
}

void keepStatics(CrowdState& state, Batch& batch) {
    for (int lane = 0; lane < batch.used; ++lane) {
        Doll& doll = state.dolls[batch.doll[lane]];
        doll.statics.clear();
        doll.touching = false;
    }
    for (const StaticContactLanes& contact : batch.contacts) {
        for (int lane = 0; lane < batch.used; ++lane) {
            const float normal = contact.normalImpulse.lane[lane];
            if (contact.key[lane] == 0 || normal <= 0.0F) continue;
            Doll& doll = state.dolls[batch.doll[lane]];
            doll.touching = true;
            doll.statics.push_back({{{normal, readVector(contact.frictionImpulse, lane)}, contact.key[lane]},
                                    readVector(contact.rollImpulse, lane),
                                    contact.body,
                                    readVector(contact.localPoint, lane),
                                    contact.radius.lane[lane],
                                    readVector(contact.normal, lane),
                                    contact.offset.lane[lane]});
        }
    }
}

// Looks for a batch's static contacts once more within a step.
void findStaticsAgain(CrowdState& state, Batch& batch, const Topology& topology, const StaticSearch& search) {
    keepStatics(state, batch);
    if (state.settings.contactReports) closeSums(state, batch);
    findBounds(state, batch, topology, search.seconds);
    findStatics(state, batch, topology, search);
    if (state.settings.contactReports) openSums(batch);
}

// One job's substep.
class JobSubstep {
  public:
    JobSubstep(CrowdState& state, Job& job, const SubstepParams& params, bool mends)
        : state_(state), job_(job), params_(params), mends_(mends) {}

    /// `next`: what the next substep needs, or null where something else comes first. Its batches are begun at once
    /// then, while they are at hand.
    void run(bool begun, const SubstepParams* next) {
        const Kernels& kernels = *state_.kernels;
        // Before the substep begins, so that the first guess of what holds sees them, as it sees gravity.
        if (!begun) {
            forBatches(state_, job_, [&](std::size_t i) { refreshStatics(i, params_); });
            for (const ForceRecord* force : job_.forces)
                job_.motorWork += applyForce(state_, *force, params_.dt);
            for (DragRecord* drag : job_.drags)
                beginDrag(state_, *drag);
            forViews([&](const BatchView& view) { kernels.begin(view, params_); });
        }
        if (params_.warmStart == 0 && !isSplit(job_))
            refreshMoved(state_, job_, params_.dt * static_cast<float>(job_.substeps) - params_.remaining);
        // What touches other bodies works on single bodies; a pass over the dolls must follow before anything moves.
        forParts(
            state_, job_, [&](PairPart& part) { kernels.beginPairs(part.view, params_); },
            [&](PairPart& part) { kernels.solvePairs(part.view, params_); },
            [&](PairPart& part) { kernels.carryPairs(part.view); });
        forViews([&](const BatchView& view) { kernels.solve(view, params_, 1); });
        for (int i = 0; i < answers(); ++i) {
            // The contacts that the dolls' answer has left wrong, and their dolls' answer to that.
            forParts(
                state_, job_, [&](PairPart& part) { kernels.pressAgain(part.view, params_, i); },
                [&](PairPart& part) { kernels.pressRest(part.view); });
            const auto isRight = [](const PairPart& part) { return part.view.changedCount == 0; };
            if (std::all_of(job_.parts.begin(), job_.parts.end(), isRight)) break;
            forViews([&](const BatchView& view) { kernels.solve(view, params_, 0); });
        }
        holdOutrun();
        forViews([&](const BatchView& view) { kernels.limitEnergy(view); });
        for (const Batch* batch : job_.batches)
            job_.motorWork += workOfMotors(*batch);
        for (const Batch* batch : job_.batches)
            job_.dragWork += workOfTargets(*batch);
        if (!state_.targets.empty()) job_.dragWork += workOfPushes(state_, job_);
        endDrags();
        if (mends_) findWedges(state_, job_, params_);
        const bool pushed = mends_ && mendPairs();
        forBatches(state_, job_, [&](std::size_t i) {
            if (mends_) mendDolls(state_, job_, i, params_, pushed);
            kernels.advance(viewOf(i), params_);
            if (next == nullptr) return;
            refreshStatics(i, *next);
            kernels.begin(viewOf(i), *next);
        });
        endWedges(job_);
        if (state_.settings.contactReports) sumImpulses(state_, job_);
    }

  private:
    // How often contacts are pressed again at most. In a heap more would cost each of its dolls a look.
    int answers() const {
        return params_.isHeap != 0 ? params_.answerSweeps : std::max(params_.answerSweeps, params_.ownSweeps);
    }

    // The faces and edges that bodies are near now: a body may have slid over an edge, unless it is still. In the first
    // substep of a step those that were found for one of this length stay.
    void refreshStatics(std::size_t i, const SubstepParams& params) {
        Batch& batch = *job_.batches[i];
        const bool isFirst = params.warmStart != 0;
        if (!batch.nearShapes || (isFirst ? batch.substeps == job_.substeps : batch.isStill)) return;
        findStaticsAgain(state_, batch, *job_.topologies[i], {params.remaining, params.dt});
    }

    // Whether there was anything to mend.
    bool mendPairs() {
        const auto mend = [&](PairPart& part) {
            part.overlaps = state_.kernels->mendPairs(part.view, params_, 0) != 0;
        };
        forParts(state_, job_, mend);
        const auto overlaps = [](const PairPart& part) { return part.overlaps; };
        if (std::none_of(job_.parts.begin(), job_.parts.end(), overlaps)) return false;
        for (int i = 1; i < params_.mendSweeps; ++i)
            forParts(state_, job_, [&](PairPart& part) {
                if (part.overlaps) state_.kernels->mendPairs(part.view, params_, i);
            });
        return true;
    }

    void endDrags() {
        vec3 onBody(0);  // what its pulls have given it together: those of a body come one after the other
        for (std::size_t i = 0; i < job_.drags.size(); ++i) {
            const DragRecord& drag = *job_.drags[i];
            const DragDeed deed = endDrag(state_, *job_.drags[i]);
            job_.dragWork += deed.work;
            onBody += deed.impulse;
            const DragRecord* next = i + 1 < job_.drags.size() ? job_.drags[i + 1] : nullptr;
            if (next != nullptr && next->doll == drag.doll && next->drag.body == drag.drag.body) continue;
            job_.dragImpulse += static_cast<double>(glm::length(onBody));
            onBody = vec3(0);
        }
    }

    // A body may have been struck towards static geometry that it was far from when contacts were looked for. It would
    // be through before the next search.
    void holdOutrun() {
        forBatches(state_, job_, [&](std::size_t i) {
            Batch& batch = *job_.batches[i];
            const Topology& topology = *job_.topologies[i];
            constexpr int kTries = 2;
            for (int tried = 0; tried < kTries; ++tried) {
                if (state_.kernels->outruns(batch.view(topology), params_) == 0 &&
                    !straysIntoStatics(state_, batch, topology, params_.dt))
                    return;
                findStaticsAgain(state_, batch, topology, {params_.remaining, params_.dt, true});
                state_.kernels->solveAgain(batch.view(topology), params_);
            }
        });
    }

    BatchView viewOf(std::size_t i) { return job_.batches[i]->view(*job_.topologies[i]); }

    template <class Work>
    void forViews(const Work& work) {
        forBatches(state_, job_, [&](std::size_t i) { work(viewOf(i)); });
    }

    CrowdState& state_;
    Job& job_;
    const SubstepParams& params_;
    bool mends_;
};

// How many contacts of some blocks press.
std::size_t countPressing(const CrowdState& state, std::size_t begin, std::size_t end) {
    std::size_t count = 0;
    for (std::size_t block = begin; block < end; ++block)
        for (int lane = 0; lane < kLanes; ++lane) {
            const bool isContact = state.touchOfLane[block][lane] >= 0;  // an empty lane repeats another
            count += isContact && state.pairs[block].normalImpulse.lane[lane] > 0.0F ? 1 : 0;
        }
    return count;
}

// Of some blocks. Nobody asks where contacts are that press no more, except for reports, which name what pressed
// before.
void keepPairs(CrowdState& state, std::size_t begin, std::size_t end) {
    for (std::size_t block = begin; block < end; ++block) {
        fetchTouches(state, block + 1);
        const PairContactLanes& pair = state.pairs[block];
        for (int lane = 0; lane < kLanes; ++lane) {
            const int index = state.touchOfLane[block][lane];
            if (index < 0) continue;
            const bool presses = pair.normalImpulse.lane[lane] > 0.0F;
            if (!presses && !state.briefs[index].presses && !state.settings.contactReports) continue;
            PairTouch& touch = state.touches[index];
            touch.carried.normal = carriedLoad(pair.kind.lane[lane], pair.normalImpulse.lane[lane],
                                               pair.load.lane[lane], pair.normalMass.lane[lane], state.tuning.ownLoad);
            touch.carried.approach = pair.approach.lane[lane];
            touch.touch.separation = pair.separation.lane[lane];
            touch.touch.normal = readVector(pair.normal, lane);
            touch.carried.friction = frictionOf(pair, lane);
            touch.touch.localA = readVector(pair.localA, lane);
            touch.touch.localB = readVector(pair.localB, lane);
            state.briefs[index].presses = presses;
            if (presses) state.carried.add(touch.carried);
        }
    }
}

}  // namespace

void solveJobs(CrowdState& state, float dt, const std::function<void()>& afterSubstep) {
    const int parts = state.tuning.substeps;
    std::vector<SubstepParams>& paramsFor = state.scratch.paramsFor;
    paramsFor.assign(static_cast<std::size_t>(state.stepSubsteps.most) + 1, {});
    for (std::size_t i = 0; i < state.jobCount; ++i) {
        const int substeps = state.jobs[i].substeps;
        if (paramsFor[substeps].dt == 0.0F) paramsFor[substeps] = paramsOf(state, dt / static_cast<float>(substeps));
    }
    for (std::size_t i = 0; i < state.jobCount; ++i)
        state.jobs[i].dragWork = state.jobs[i].dragImpulse = state.jobs[i].motorWork = 0.0;
    // In the order of the jobs, so that the sum is the same at every thread count.
    const auto takeDragWork = [&] {
        for (std::size_t i = 0; i < state.jobCount; ++i) {
            // A doll that is about to be put back (World::caught) must not spoil the sums for good.
            if (std::isfinite(state.jobs[i].dragWork)) state.dragWork += state.jobs[i].dragWork;
            if (std::isfinite(state.jobs[i].dragImpulse)) state.dragImpulse += state.jobs[i].dragImpulse;
            if (std::isfinite(state.jobs[i].motorWork)) state.motorWork += state.jobs[i].motorWork;
            state.jobs[i].dragWork = state.jobs[i].dragImpulse = state.jobs[i].motorWork = 0.0;
        }
    };
    const auto paramsAt = [&](const Job& job, int index) {
        SubstepParams params = paramsFor[job.substeps];
        params.isHeap = isHeap(job) ? 1 : 0;
        if (params.isHeap != 0) {
            params.ownDepth = params.heapDepth;
            params.ownSpeed = params.heapSpeed;
        }
        params.warmStart = index == 0 ? 1 : 0;
        params.remaining = params.dt * static_cast<float>(job.substeps - index);
        return params;
    };
    // Whether nothing has to come between two substeps of a job.
    const auto runsOn = [&](const Job& job) {
        return !afterSubstep && !state.settings.contactReports && job.forces.empty() && job.drags.empty();
    };
    const auto substep = [&](Job& job, int index) {
        const int left = job.substeps - index;
        const SubstepParams params = paramsAt(job, index);
        const SubstepParams next = paramsAt(job, index + 1);
        if (index == 0) fitImpulses(state, job, params.dt);
        const bool mends = (left - 1) % state.tuning.mendEvery == 0;
        JobSubstep(state, job, params, mends).run(index > 0 && runsOn(job), left > 1 && runsOn(job) ? &next : nullptr);
    };
    if (afterSubstep) {
        for (int i = 0; i < parts; ++i) {
            // A job of fewer substeps is behind by less than one of them; one of more makes some in each part.
            forJobs(state, [&](Job& job) {
                for (int done = i * job.substeps / parts; done < (i + 1) * job.substeps / parts; ++done)
                    substep(job, done);
            });
            takeDragWork();
            afterSubstep();
        }
    } else {
        forJobs(state, [&](Job& job) {
            for (int i = 0; i < job.substeps; ++i)
                substep(job, i);
        });
    }
    takeDragWork();
    keepMotors(state);
}

void keepImpulses(CrowdState& state) {
    state.inParallel(state.active.size(), 4, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            keepStatics(state, *state.active[i]);
    });
    std::atomic<std::size_t> pressing = 0;
    state.inParallel(state.pairs.size(), 64,
                     [&](std::size_t begin, std::size_t end) { pressing += countPressing(state, begin, end); });
    state.carried.renew(pressing);
    state.inParallel(state.pairs.size(), 64, [&](std::size_t begin, std::size_t end) { keepPairs(state, begin, end); });
}

}  // namespace lutka::physics::crowd
