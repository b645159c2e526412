#include <atomic>
#include <numeric>
#include <vector>

#include "core/task_pool.hpp"
#include "support/catch.hpp"

using lutka::TaskPool;

TEST_CASE("parallelFor visits every index once at any thread count") {
    for (const int threads : {1, 2, 5}) {
        const TaskPool pool(threads);
        CHECK(pool.threads() == threads);
        std::vector<int> visits(1000, 0);
        pool.parallelFor(visits.size(), 7, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i)
                ++visits[i];
        });
        CHECK(std::count(visits.begin(), visits.end(), 1) == 1000);
    }
}

TEST_CASE("parallelFor with nothing to do calls nothing") {
    std::atomic<int> calls = 0;
    TaskPool(2).parallelFor(0, 1, [&](std::size_t, std::size_t) { ++calls; });
    CHECK(calls == 0);
}
