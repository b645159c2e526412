#include "editor/view/quality_governor.hpp"

#include "support/catch.hpp"

using namespace lutka::editor;

TEST_CASE("a halting picture steps down at once, a late one after a few, and an easy one comes back slowly") {
    QualityGovernor governor;
    CHECK(governor.quality().share == 1.0F);
    CHECK(governor.quality().ambientOcclusion);
    governor.update(0.5);  // two pictures a second
    CHECK_FALSE(governor.quality().ambientOcclusion);
    governor.update(0.3);
    const float coarse = governor.quality().share;
    CHECK(coarse < 0.6F);
    for (int i = 0; i + 1 < QualityGovernor::kLateFrames; ++i)
        governor.update(0.1);
    CHECK(governor.quality().share == coarse);
    governor.update(0.1);
    CHECK(governor.quality().share < coarse);
    CHECK(governor.quality().share > 0.3F);  // there is an end
    for (int i = 0; i < 10 * QualityGovernor::kEasyFrames; ++i)
        governor.update(0.002);
    CHECK(governor.quality().share == 1.0F);
    CHECK(governor.quality().ambientOcclusion);
}

TEST_CASE("quality does not swing: what would be late again is not tried") {
    QualityGovernor governor;
    governor.update(0.4);
    governor.update(0.25);
    const float share = governor.quality().share;
    REQUIRE(share < 1.0F);
    for (int i = 0; i < 3 * QualityGovernor::kEasyFrames; ++i)
        governor.update(0.028);
    CHECK(governor.quality().share == share);
}

TEST_CASE("a step down that does not help is taken back, and not tried again for a while") {
    QualityGovernor governor;
    governor.update(0.4);
    const float first = governor.quality().share;
    governor.update(0.25);
    CHECK(governor.quality().share < first);
    governor.update(0.25);  // as slow as before
    CHECK(governor.quality().share == first);
    for (int i = 0; i < 20; ++i)
        governor.update(0.25);
    CHECK(governor.quality().share == first);
}
