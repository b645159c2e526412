#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>

#include "core/task_arena.hpp"

namespace lutka {
namespace {

class TbbArena final : public TaskArena {
  public:
    explicit TbbArena(int threads)
        : limit_(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads)), arena_(threads) {}

    void run(std::size_t count, std::size_t grain, const Body& body) override {
        arena_.execute([&] {
            tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, std::max<std::size_t>(grain, 1)),
                              [&](const tbb::blocked_range<std::size_t>& range) { body(range.begin(), range.end()); });
        });
    }

  private:
    tbb::global_control limit_;  // without it TBB caps the arena at the number of processors
    tbb::task_arena arena_;
};

}  // namespace

std::unique_ptr<TaskArena> makeTbbArena(int threads) {
    return std::make_unique<TbbArena>(threads);
}

}  // namespace lutka
