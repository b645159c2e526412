#include "physics/crowd/parts.hpp"

#include <algorithm>
#include <array>

namespace lutka::physics::crowd {
namespace {

// Positions along the axis are told apart by so many steps.
constexpr int kBins = 256;
// A job has no more parts than about so many: enough for a dozen threads.
constexpr std::size_t kMostParts = 32;
static_assert(2 * kMostParts <= static_cast<std::size_t>(TaskPool::kMostItems));

// An axis and a stretch of it.
struct Stretch {
    int axis = 0;
    float low = 0.0F;
    float high = 0.0F;
};

// Where the contacts of a job lie, by a sample of them. A few that lie far off do not count for much.
Stretch stretchOf(const CrowdState& state, const Job& job) {
    constexpr std::size_t kEvery = 32;
    constexpr float kReach = 3.0F;  // mean distances from the mean
    const std::size_t count = (job.touches.size() + kEvery - 1) / kEvery;
    const auto placeOf = [&](std::size_t i) {
        const PairTouch& touch = state.touches[job.touches[i * kEvery]];
        const Doll& doll = state.dolls[touch.dollA];
        return readVector(state.batchOf(doll).bodies[touch.bodyA].position, doll.lane);
    };
    vec3 sum(0);
    for (std::size_t i = 0; i < count; ++i)
        sum += placeOf(i);
    const vec3 mean = sum / static_cast<float>(count);
    vec3 off(0);
    for (std::size_t i = 0; i < count; ++i)
        off += glm::abs(placeOf(i) - mean);
    off /= static_cast<float>(count);
    int axis = 0;
    for (int i = 1; i < 3; ++i)
        if (off[i] > off[axis]) axis = i;
    return {axis, mean[axis] - kReach * off[axis], mean[axis] + kReach * off[axis]};
}

// Where along it each body is that a contact of the job pushes. What is not finite comes first.
void findBins(CrowdState& state, const Job& job, const Stretch& stretch) {
    const float scale = static_cast<float>(kBins) / std::max(stretch.high - stretch.low, 1e-6F);
    state.inParallel(job.batches.size(), 8, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const Batch& batch = *job.batches[i];
            for (const int body : batch.paired) {
                const Wide3& position = batch.bodies[body].position;
                const Wide& along = stretch.axis == 0 ? position.x : stretch.axis == 1 ? position.y : position.z;
                for (int lane = 0; lane < batch.used; ++lane) {
                    const float at = (along.lane[lane] - stretch.low) * scale;
                    const float last = static_cast<float>(kBins - 1);
                    state.binOf[static_cast<std::size_t>(batch.firstBody[lane]) + static_cast<std::size_t>(body)] =
                        at > 0.0F ? static_cast<std::uint8_t>(std::min(at, last)) : std::uint8_t{0};
                }
            }
        }
    });
}

// Of the contacts that begin in each bin: how many press, how many do not, and the last bin that one of them reaches.
struct Bins {
    std::array<int, 2 * kBins> count{};
    std::array<int, kBins> reach{};
};

struct Span {
    int first, last;
};
Span spanOf(const CrowdState& state, const TouchBrief& brief) {
    const int a = state.binOf[brief.bodyA];
    const int b = state.binOf[brief.bodyB];
    return {std::min(a, b), std::max(a, b)};
}

// Numbers the parts by bins. Returns how many there are.
int cutBins(const Bins& bins, std::size_t touches, std::array<int, kBins>& partOf) {
    const int enough = static_cast<int>(touches / kMostParts);
    int part = 0;
    int inPart = 0;
    int reach = 0;       // of all contacts so far
    int reachAtCut = 0;  // of those that begin before this part
    for (int bin = 0; bin < kBins; ++bin) {
        if (bin > reachAtCut && inPart > enough) {
            ++part;
            inPart = 0;
            reachAtCut = reach;
        }
        partOf[bin] = part;
        inPart += bins.count[2 * bin] + bins.count[2 * bin + 1];
        reach = std::max(reach, bins.reach[bin]);
    }
    return part + 1;
}

// The bins that the contacts of a job begin in; and of each contact twice its bin, and 1 more where it hardly presses.
Bins countBins(CrowdState& state, const Job& job, bool cut) {
    Bins bins;
    std::vector<std::uint16_t>& keys = state.scratch.keys;
    keys.resize(job.touches.size());
    for (std::size_t i = 0; i < keys.size(); ++i) {
        const TouchBrief& brief = state.briefs[job.touches[i]];
        const Span span = cut ? spanOf(state, brief) : Span{0, 0};
        const int kind = brief.presses ? 0 : 1;
        keys[i] = static_cast<std::uint16_t>(2 * span.first + kind);
        ++bins.count[keys[i]];
        bins.reach[span.first] = std::max(bins.reach[span.first], span.last);
    }
    return bins;
}

void partJob(CrowdState& state, Job& job) {
    const bool cut = isSplit(job) && !job.touches.empty();
    if (cut) findBins(state, job, stretchOf(state, job));
    const Bins bins = countBins(state, job, cut);
    std::array<int, kBins> partOf{};
    job.parts.assign(static_cast<std::size_t>(cut ? cutBins(bins, job.touches.size(), partOf) : 1), {});
    // Sorted by counting: part by part, those that press first, since what will hardly press shares blocks, which are
    // left early.
    std::array<int, 2 * kBins> slotOf{};
    std::array<int, 2 * kBins> next{};  // place of each slot's next contact
    for (int key = 0; key < 2 * kBins; ++key) {
        slotOf[key] = 2 * partOf[key / 2] + key % 2;
        next[slotOf[key]] += bins.count[key];
    }
    int end = 0;
    for (std::size_t i = 0; i < job.parts.size(); ++i) {
        job.parts[i].firstTouch = static_cast<std::size_t>(end);
        for (int kind = 0; kind < 2; ++kind) {
            const int count = next[2 * i + kind];
            next[2 * i + kind] = end;
            end += count;
        }
        job.parts[i].touchCount = static_cast<std::size_t>(end) - job.parts[i].firstTouch;
    }
    std::vector<int>& sorted = state.scratch.sorted;
    sorted.resize(job.touches.size());
    for (std::size_t i = 0; i < sorted.size(); ++i)
        sorted[next[slotOf[state.scratch.keys[i]]]++] = job.touches[i];
    // Swapped, each job in turn would keep room for the largest one's.
    std::copy(sorted.begin(), sorted.end(), job.touches.begin());
}

}  // namespace

void partTouches(CrowdState& state) {
    state.binOf.resize(static_cast<std::size_t>(state.bodyTotal));
    for (std::size_t i = 0; i < state.jobCount; ++i)
        partJob(state, state.jobs[i]);
}

}  // namespace lutka::physics::crowd
