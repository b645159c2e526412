#include <algorithm>
#include <atomic>
#include <numeric>
#include <stdexcept>
#include <thread>
#include <vector>

#include "core/task_arena.hpp"
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

TEST_CASE("an exception in a piece of work reaches the caller once nothing runs, and the pool works on") {
    for (const int threads : {1, 2, 5}) {
        const TaskPool pool(threads);
        for (int round = 0; round < 20; ++round) {
            std::atomic<int> running = 0;
            const auto failing = [&](std::size_t begin, std::size_t end) {
                ++running;
                const bool fails = begin <= 500 && 500 < end;
                --running;
                if (fails) throw std::runtime_error("piece with 500");
            };
            CHECK_THROWS_WITH(pool.parallelFor(1000, 7, failing), "piece with 500");
            CHECK(running == 0);
        }
        std::atomic<std::size_t> visited = 0;
        pool.parallelFor(1000, 7, [&](std::size_t begin, std::size_t end) { visited += end - begin; });
        CHECK(visited == 1000);
    }
}

TEST_CASE("when every piece throws, one exception arrives") {
    const TaskPool pool(3);
    CHECK_THROWS_AS(pool.parallelFor(100, 1, [](std::size_t, std::size_t) { throw std::logic_error("each"); }),
                    std::logic_error);
}

TEST_CASE("either kind of threads does every piece once, hands on what a piece throws, and takes a call from a piece") {
    const bool forkJoin = GENERATE(false, true);
    const auto arena = forkJoin ? lutka::makeForkJoinArena(4) : lutka::makeTbbArena(4);
    for (const std::size_t count : {std::size_t{1}, std::size_t{3}, std::size_t{1000}}) {
        std::vector<int> visits(count, 0);
        for (int round = 0; round < 50; ++round)
            arena->run(count, 2, [&](std::size_t begin, std::size_t end) {
                for (std::size_t i = begin; i < end; ++i)
                    ++visits[i];
            });
        CHECK(std::count(visits.begin(), visits.end(), 50) == static_cast<std::ptrdiff_t>(count));
    }
    CHECK_THROWS_WITH(arena->run(100, 1, [](std::size_t, std::size_t) { throw std::runtime_error("a piece"); }),
                      "a piece");
    std::atomic<std::size_t> inner = 0;
    arena->run(8, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            arena->run(10, 1, [&](std::size_t first, std::size_t last) { inner += last - first; });
    });
    CHECK(inner == 80);
}

TEST_CASE("two threads may give one team work at a time") {
    const auto arena = lutka::makeForkJoinArena(3);
    std::atomic<std::size_t> done = 0;
    const auto give = [&] {
        for (int round = 0; round < 100; ++round)
            arena->run(50, 1, [&](std::size_t begin, std::size_t end) { done += end - begin; });
    };
    std::thread other(give);
    give();
    other.join();
    CHECK(done == 2 * 100 * 50);
}

TEST_CASE("rounds on a row of items: none beside one at work, each after its neighbours' calls that come before it") {
    constexpr int kRounds = 4;
    for (const int threads : {1, 2, 5}) {
        const TaskPool pool(threads);
        for (const int items : {1, 2, 3, 17}) {
            // What each call saw of its item and of those beside it: how many calls these had had.
            std::vector<int> calls(items, 0);
            std::vector<std::atomic<bool>> busy(items);
            std::atomic<int> wrong = 0;
            for (int again = 0; again < 20; ++again) {
                std::fill(calls.begin(), calls.end(), 0);
                pool.parallelRounds(kRounds, items, [&](int round, int item) {
                    busy[item] = true;
                    const int beside = item % 2 == 0 ? round : round + 1;
                    for (const int other : {item - 1, item + 1}) {
                        if (other < 0 || other >= items) continue;
                        if (busy[other] || calls[other] != beside) ++wrong;
                    }
                    if (calls[item]++ != round) ++wrong;
                    busy[item] = false;
                });
                CHECK(std::count(calls.begin(), calls.end(), kRounds) == items);
            }
            CHECK(wrong == 0);
        }
    }
}

TEST_CASE("rounds of nothing call nothing, and what a round throws reaches the caller") {
    for (const int threads : {1, 3}) {
        const TaskPool pool(threads);
        std::atomic<int> calls = 0;
        pool.parallelRounds(0, 5, [&](int, int) { ++calls; });
        pool.parallelRounds(5, 0, [&](int, int) { ++calls; });
        CHECK(calls == 0);
        const auto failing = [](int round, int item) {
            if (round == 1 && item == 2) throw std::runtime_error("item 2");
        };
        CHECK_THROWS_WITH(pool.parallelRounds(3, 8, failing), "item 2");
        pool.parallelRounds(3, 8, [&](int, int) { ++calls; });
        CHECK(calls == 24);
    }
}
