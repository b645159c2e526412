#include "core/task_rounds.hpp"

#include "core/assert.hpp"

namespace lutka {

namespace {
constexpr int kNone = -1;
}

TaskRounds::TaskRounds(int rounds, int items) : rounds_(rounds), items_(items), left_(rounds * items) {
    LUTKA_ASSERT(items <= TaskPool::kMostItems);
}

// Rounds are counted in halves: an item that is at work in round r stands at 2 r + 1, one that has ended it at 2 r + 2.
bool TaskRounds::isReady(int item) const {
    const int at = next_[item];
    if (at % 2 != 0 || at == 2 * rounds_) return false;
    const int needed = item % 2 == 0 ? at : at + 2;  // even items come first, and wait for the round before
    const bool left = item == 0 || next_[item - 1] == needed;
    const bool right = item + 1 == items_ || next_[item + 1] == needed;
    return left && right;
}

int TaskRounds::take() {
    std::unique_lock lock(mutex_);
    while (left_ > 0) {
        int best = kNone;
        for (int item = 0; item < items_; ++item)
            if (isReady(item) && (best == kNone || next_[item] < next_[best])) best = item;
        if (best != kNone) {
            ++next_[best];
            return best;
        }
        ++waiting_;
        ended_.wait(lock);
        --waiting_;
    }
    return kNone;
}

void TaskRounds::end(int item) {
    const std::lock_guard lock(mutex_);
    ++next_[item];
    --left_;
    if (waiting_ > 0) ended_.notify_all();
}

void TaskRounds::work(const Body& body) {
    for (int item = take(); item != kNone; item = take()) {
        try {
            body(next_[item] / 2, item);
        } catch (...) {
            const std::lock_guard lock(mutex_);
            left_ = 0;
            ended_.notify_all();
            throw;
        }
        end(item);
    }
}

}  // namespace lutka
