#include "core/task_pool.hpp"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <future>
#include <system_error>
#include <thread>
#include <vector>

#include "core/task_arena.hpp"
#include "core/task_rounds.hpp"

namespace lutka {
namespace {

// How many threads of `wanted` may run beside this one: oneTBB ends the program when it can't make one of its own, so
// that is tried first, with a quarter more of them alive at once. Containers and `ulimit -v` are where it fails.
int threadsToBeHad(int wanted) {
    const int tried = wanted + wanted / 4 + 1;
    std::atomic<int> ready{0};
    std::atomic<bool> starved{false};
    std::promise<void> finished;
    const std::shared_future<void> end = finished.get_future().share();
    std::vector<std::thread> threads;
    threads.reserve(static_cast<std::size_t>(tried));
    try {
        while (static_cast<int>(threads.size()) < tried)
            threads.emplace_back([&, end] {
                // The C library reserves address space for a thread when it first allocates; oneTBB's all do.
                void* const own = std::malloc(64);
                if (own == nullptr) starved = true;
                ++ready;
                end.wait();
                std::free(own);
            });
    } catch (const std::system_error&) {  // as many as there are, then
    }
    const int had = static_cast<int>(threads.size());
    while (ready < had)
        std::this_thread::yield();
    finished.set_value();
    for (std::thread& thread : threads)
        thread.join();
    // A quarter of what there was, where it was short: the simulation needs memory, too.
    return had == tried && !starved ? wanted : std::min(wanted, had / 4);
}

}  // namespace

struct TaskPool::Arena {
    std::unique_ptr<TaskArena> threads;
};

TaskPool::TaskPool(int threads) {
    const int wanted = threads == 0 ? static_cast<int>(std::thread::hardware_concurrency()) : threads;
    threads_ = std::clamp(wanted, 1, 256);
    if (threads_ > 1) threads_ = 1 + threadsToBeHad(threads_ - 1);
    if (threads_ == 1) return;
#ifdef LUTKA_FORK_JOIN
    arena_ = std::make_unique<Arena>(Arena{makeForkJoinArena(threads_)});
#else
    arena_ = std::make_unique<Arena>(Arena{makeTbbArena(threads_)});
#endif
}

TaskPool::~TaskPool() = default;
TaskPool::TaskPool(TaskPool&&) noexcept = default;
TaskPool& TaskPool::operator=(TaskPool&&) noexcept = default;

int TaskPool::threads() const {
    return threads_;
}

void TaskPool::parallelFor(std::size_t count, std::size_t grain,
                           const std::function<void(std::size_t, std::size_t)>& body) const {
    if (count == 0) return;
    if (arena_ == nullptr || count <= grain) {
        body(0, count);
        return;
    }
    arena_->threads->run(count, grain, body);
}

void TaskPool::parallelRounds(int rounds, int items, const std::function<void(int, int)>& body) const {
    if (rounds <= 0 || items <= 0) return;
    TaskRounds work(rounds, items);
    // Whoever is free takes part, and whoever comes late finds nothing left.
    const auto take = [&](std::size_t, std::size_t) { work.work(body); };
    parallelFor(static_cast<std::size_t>(std::min(threads_, (items + 1) / 2)), 1, std::cref(take));
}

}  // namespace lutka
