#pragma once

#include "physics/crowd/state.hpp"

namespace lutka::physics::crowd {

/// Splits the step into jobs (batches that touch each other) and packs each job's contacts between bodies into blocks
/// of lanes in which no body comes twice.
void makeJobs(CrowdState& state);

/// Whether dolls of several batches touch: what presses one of them then is many others. Props, which answer nothing,
/// make no heap, and dolls of a single batch may be far from each other.
[[nodiscard]] bool isHeap(const Job& job);

/// Calls work(job) for all jobs: small ones side by side, then the large ones, each of which uses all threads itself.
template <class Work>
void forJobs(CrowdState& state, const Work& work) {
    state.inParallel(state.jobCount, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            if (!isSplit(state.jobs[i])) work(state.jobs[i]);
    });
    for (std::size_t i = 0; i < state.jobCount; ++i)
        if (isSplit(state.jobs[i])) work(state.jobs[i]);
}

/// Calls work(i) for all batches of a job by their place in it: on all threads where the job is split.
template <class Work>
void forBatches(const CrowdState& state, const Job& job, const Work& work) {
    const auto range = [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            work(i);
    };
    if (isSplit(job))
        state.inParallel(job.batches.size(), 1, range);
    else
        range(0, job.batches.size());
}

/// Calls works(part) for all parts of a job's contacts, one of the works after the other, in each every other part
/// first; what shares no body side by side. The order of what shares bodies does not depend on the threads.
template <class... Works>
void forParts(const CrowdState& state, Job& job, const Works&... works) {
    const auto body = [&](int round, int part) {
        int at = 0;
        (..., (at++ == round ? static_cast<void>(works(job.parts[part])) : void()));
    };
    if (job.parts.size() == 1) {
        for (int round = 0; round < static_cast<int>(sizeof...(works)); ++round)
            body(round, 0);
    } else {
        state.pool.parallelRounds(sizeof...(works), static_cast<int>(job.parts.size()), std::cref(body));
    }
}

}  // namespace lutka::physics::crowd
