#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace lutka {

/// Threads that stand by for a TaskPool and share out its work.
class TaskArena {
  public:
    using Body = std::function<void(std::size_t begin, std::size_t end)>;

    virtual ~TaskArena() = default;
    /// What TaskPool::parallelFor() promises; `count` > 0.
    virtual void run(std::size_t count, std::size_t grain, const Body& body) = 0;
};

/// oneTBB's threads: what TaskPool has. `threads` > 1, the calling one among them; as many must be there to be had.
[[nodiscard]] std::unique_ptr<TaskArena> makeTbbArena(int threads);

/// A team of std::thread that forks and joins, with one lock and two conditions, for ThreadSanitizer: that can't follow
/// what oneTBB's library, which was built without it, does to keep its threads apart. TaskPool has it where
/// LUTKA_SANITIZE_THREADS was given. A call from a piece of work, or while another thread's call runs, is a plain call
/// of body(0, count).
[[nodiscard]] std::unique_ptr<TaskArena> makeForkJoinArena(int threads);

}  // namespace lutka
