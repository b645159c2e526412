#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "core/task_arena.hpp"

namespace lutka {
namespace {

// So many pieces a thread, where the grain allows: a thread that is late holds the others up for one piece at most.
constexpr std::size_t kPiecesPerThread = 4;

class ForkJoinArena final : public TaskArena {
  public:
    explicit ForkJoinArena(int threads) {
        helpers_.reserve(static_cast<std::size_t>(threads) - 1);
        try {
            while (static_cast<int>(helpers_.size()) + 1 < threads)
                helpers_.emplace_back([this] { help(); });
        } catch (const std::system_error&) {  // as many as there are, then
        }
    }
    ForkJoinArena(const ForkJoinArena&) = delete;
    ForkJoinArena& operator=(const ForkJoinArena&) = delete;
    ~ForkJoinArena() override {
        {
            const std::lock_guard lock(mutex_);
            ended_ = true;
        }
        forked_.notify_all();
        for (std::thread& helper : helpers_)
            helper.join();
    }

    void run(std::size_t count, std::size_t grain, const Body& body) override {
        if (taken_.exchange(true)) {
            body(0, count);
            return;
        }
        {
            const std::lock_guard lock(mutex_);
            body_ = &body;
            count_ = count;
            const std::size_t pieces = kPiecesPerThread * (helpers_.size() + 1);
            piece_ = std::max({grain, (count + pieces - 1) / pieces, std::size_t{1}});
            next_ = 0;
            failure_ = nullptr;
            working_ = helpers_.size();
            ++round_;
        }
        forked_.notify_all();
        work();
        std::unique_lock lock(mutex_);
        joined_.wait(lock, [&] { return working_ == 0; });
        const std::exception_ptr failure = std::exchange(failure_, nullptr);
        lock.unlock();
        taken_ = false;
        if (failure != nullptr) std::rethrow_exception(failure);
    }

  private:
    void help() {
        std::size_t known = 0;
        std::unique_lock lock(mutex_);
        while (true) {
            forked_.wait(lock, [&] { return ended_ || round_ != known; });
            if (ended_) return;
            known = round_;
            lock.unlock();
            work();
            lock.lock();
            if (--working_ == 0) joined_.notify_one();
        }
    }

    // Takes pieces until none is left. What a round consists of changes only while nobody is here.
    void work() {
        while (true) {
            const std::size_t begin = next_.fetch_add(piece_);
            if (begin >= count_) return;
            try {
                (*body_)(begin, std::min(begin + piece_, count_));
            } catch (...) {
                const std::lock_guard lock(mutex_);
                if (failure_ == nullptr) failure_ = std::current_exception();
                next_ = count_;
            }
        }
    }

    std::mutex mutex_;
    std::condition_variable forked_;
    std::condition_variable joined_;
    const Body* body_ = nullptr;
    std::size_t count_ = 0;
    std::size_t piece_ = 1;
    std::atomic<std::size_t> next_{0};
    std::atomic<bool> taken_{false};
    std::exception_ptr failure_;
    std::size_t working_ = 0;  // helpers that have not ended the present round
    std::size_t round_ = 0;
    bool ended_ = false;
    std::vector<std::thread> helpers_;  // last: they use all of the above
};

}  // namespace

std::unique_ptr<TaskArena> makeForkJoinArena(int threads) {
    return std::make_unique<ForkJoinArena>(threads);
}

}  // namespace lutka
