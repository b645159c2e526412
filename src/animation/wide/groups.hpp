#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>
#include <span>

#include "animation/wide/layout.hpp"
#include "core/task_pool.hpp"

namespace lutka::animation::wide {

/// Working memory of kernels that run side by side on a pool: one slice for each piece of work.
class Scratch {
  public:
    /// `floats` for each of the pool's pieces, aligned to 64 bytes.
    Scratch(const TaskPool& pool, std::size_t floats);

    [[nodiscard]] std::size_t pieces() const { return pieces_; }
    [[nodiscard]] float* slice(std::size_t piece) const { return memory_.get() + piece * stride_; }

  private:
    struct Free {
        void operator()(float* memory) const;
    };
    std::size_t pieces_;
    std::size_t stride_;
    std::unique_ptr<float, Free> memory_;
};

/// Calls run(lanes, scratch) for groups of `lanes` of the instances, over the pool; the last group's free lanes repeat
/// its last instance. `run` must be callable from several threads.
template <class Run>
void forGroups(const TaskPool& pool, const Scratch& scratch, std::span<const int> instances, int lanes,
               const Run& run) {
    const auto width = static_cast<std::size_t>(lanes);
    const std::size_t groups = (instances.size() + width - 1) / width;
    const std::size_t pieces = std::min(scratch.pieces(), groups);
    const auto work = [&](std::size_t begin, std::size_t end) {
        for (std::size_t piece = begin; piece < end; ++piece) {
            for (std::size_t group = groups * piece / pieces; group < groups * (piece + 1) / pieces; ++group) {
                int members[kMostLanes];
                for (std::size_t lane = 0; lane < width; ++lane)
                    members[lane] = instances[std::min(group * width + lane, instances.size() - 1)];
                run(members, scratch.slice(piece));
            }
        }
    };
    pool.parallelFor(pieces, 1, std::cref(work));  // by reference: a copy of its captures would be on the heap
}

}  // namespace lutka::animation::wide
