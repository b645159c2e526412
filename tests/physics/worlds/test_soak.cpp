#include "support/soak.hpp"

#include "support/catch.hpp"

using namespace lutka;

TEST_CASE("a hundred dolls thrown about for half a minute, others in their place all along, lose and leak nothing") {
    test::SoakOptions options;
    const test::SoakResult result = test::soak(options);
    CHECK(result.wrong.empty());
    INFO(result.wrong);
    CHECK(result.steps == 1800);
    CHECK(result.added > 900);
    CHECK(result.caught == 0);
#if !defined(__SANITIZE_ADDRESS__)  // it keeps what is freed for a while
    CHECK(result.residentGrowthMb < 1.0);
#endif
}
