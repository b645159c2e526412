#include "physics/crowd/broadphase.hpp"

#include <algorithm>
#include <numeric>

#include "physics/crowd/bounds.hpp"

namespace lutka::physics::crowd {
namespace {

// The bounds of all dolls by their low end along x. They come in the order of the step before, which is nearly that of
// this one: sorting by insertion looks at each a few times.
void sortAlongX(CrowdState& state, float dt) {
    std::vector<Swept>& swept = state.scratch.swept;
    swept.resize(state.sweep.size());
    for (std::size_t i = 0; i < swept.size(); ++i)
        swept[i] = {worldBounds(state.dolls[state.sweep[i]], dt), state.sweep[i]};
    for (std::size_t i = 1; i < swept.size(); ++i) {
        if (swept[i - 1].bounds.low.x <= swept[i].bounds.low.x) continue;
        const Swept moving = swept[i];
        std::size_t to = i;
        for (; to > 0 && swept[to - 1].bounds.low.x > moving.bounds.low.x; --to)
            swept[to] = swept[to - 1];
        swept[to] = moving;
    }
    state.sweptBoxes.resize((swept.size() + kLanes - 1) / kLanes);
    for (std::size_t i = 0; i < state.sweptBoxes.size() * kLanes; ++i) {
        const bool isDoll = i < swept.size();
        if (isDoll) state.sweep[i] = swept[i].doll;
        writeBox(state.sweptBoxes[i / kLanes], static_cast<int>(i % kLanes), isDoll ? swept[i].bounds : Aabb{});
    }
}

bool mayTouch(const CrowdState& state, int a, int b) {
    const Doll& first = state.dolls[a];
    const Doll& second = state.dolls[b];
    return !(first.asleep() && second.asleep()) && first.filter.collidesWith(second.filter);
}

// So many dolls of the sweep look at once for those after them that they meet.
constexpr std::size_t kSweptPiece = 32;

void sweepPiece(const CrowdState& state, std::size_t piece, SweptPairs& out) {
    const std::vector<int>& sweep = state.sweep;
    out.near.resize(state.sweptBoxes.size() * kLanes);
    out.pairs.clear();
    for (std::size_t i = piece * kSweptPiece; i < std::min((piece + 1) * kSweptPiece, sweep.size()); ++i) {
        const int count = state.kernels->findBoxesAfter(state.sweptBoxes.data(), static_cast<int>(sweep.size()),
                                                        static_cast<int>(i), out.near.data());
        for (int k = 0; k < count; ++k)
            if (mayTouch(state, sweep[i], sweep[out.near[k]]))
                out.pairs.push_back(std::minmax(sweep[i], sweep[out.near[k]]));
    }
}

// The pairs found into CrowdState::dollPairs, in the order of their dolls: by counting for the first, by sorting the
// few that share it for the second.
void orderPairs(CrowdState& state) {
    std::vector<int>& firstOf = state.scratch.firstOf;
    firstOf.assign(state.dolls.size() + 1, 0);
    for (const SweptPairs& piece : state.scratch.sweptPairs)
        for (const std::pair<int, int>& pair : piece.pairs)
            ++firstOf[static_cast<std::size_t>(pair.first) + 1];
    std::partial_sum(firstOf.begin(), firstOf.end(), firstOf.begin());
    state.scratch.next.assign(firstOf.begin(), firstOf.end() - 1);
    state.dollPairs.resize(static_cast<std::size_t>(firstOf.back()));
    for (const SweptPairs& piece : state.scratch.sweptPairs)
        for (const std::pair<int, int>& pair : piece.pairs)
            state.dollPairs[state.scratch.next[pair.first]++] = pair;
    state.inParallel(state.dolls.size(), 32, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            std::sort(state.dollPairs.begin() + firstOf[i], state.dollPairs.begin() + firstOf[i + 1]);
    });
}

}  // namespace

void sweepDolls(CrowdState& state, float dt) {
    sortAlongX(state, dt);
    std::vector<SweptPairs>& pieces = state.scratch.sweptPairs;
    pieces.resize((state.sweep.size() + kSweptPiece - 1) / kSweptPiece);
    state.inParallel(pieces.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            sweepPiece(state, i, pieces[i]);
    });
    orderPairs(state);
}

}  // namespace lutka::physics::crowd
