#pragma once

#include <array>
#include <condition_variable>
#include <functional>
#include <mutex>

#include "core/task_pool.hpp"

namespace lutka {

/// The order of TaskPool::parallelRounds(): hands out the calls to whoever asks.
class TaskRounds {
  public:
    using Body = std::function<void(int round, int item)>;

    TaskRounds(int rounds, int items);

    /// Takes part until no call is left, or one has failed.
    void work(const Body& body);

  private:
    [[nodiscard]] int take();
    void end(int item);
    [[nodiscard]] bool isReady(int item) const;

    std::mutex mutex_;
    std::condition_variable ended_;
    int rounds_;
    int items_;
    std::array<int, TaskPool::kMostItems> next_{};  // of an item: twice the round that comes next, 1 more while in it
    int left_;                                      // calls that have not ended
    int waiting_ = 0;
};

}  // namespace lutka
