#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace lutka {

/// Runs independent pieces of work on several threads, with blocking waits (no spinning). oneTBB behind one header.
/// Results never depend on the number of threads as long as the pieces are independent.
class TaskPool {
  public:
    /// `threads` includes the calling thread; 0 takes one a processor. Clamped to [1, 256].
    explicit TaskPool(int threads = 1);
    ~TaskPool();
    TaskPool(TaskPool&&) noexcept;
    TaskPool& operator=(TaskPool&&) noexcept;

    [[nodiscard]] int threads() const;

    /// Calls body(begin, end) over [0, count) in pieces of at least `grain` items and returns when all are done.
    /// With one thread it is a plain call of body(0, count). An exception of a piece reaches the caller once no piece
    /// runs any more; pieces that had not begun may be left out. The pool can be used again.
    void parallelFor(std::size_t count, std::size_t grain,
                     const std::function<void(std::size_t begin, std::size_t end)>& body) const;

    /// `rounds` of work on a row of items of which neighbours must not be worked on at the same time: body(round, item)
    /// for each round and item. The outcome is that of one round after another, the even items before the odd ones, at
    /// any number of threads. A call waits only for those of its neighbours and its own item: in the round before, and,
    /// for an odd item, in the same round. An exception reaches the caller as in parallelFor(). At most kMostItems.
    static constexpr int kMostItems = 64;
    void parallelRounds(int rounds, int items, const std::function<void(int round, int item)>& body) const;

  private:
    struct Arena;
    std::unique_ptr<Arena> arena_;
    int threads_ = 1;
};

}  // namespace lutka
