#include "editor/view/quality_governor.hpp"

#include "support/catch.hpp"

using namespace lutka::editor;

TEST_CASE("a halting picture steps down at once, a late one after a few, and an easy one comes back slowly") {
    QualityGovernor governor;
    CHECK(governor.quality().share == 1.0F);
    CHECK(governor.quality().ambientOcclusion);
    governor.update(0.5);  // two pictures a second
    CHECK_FALSE(governor.quality().ambientOcclusion);
    governor.update(0.4);
    governor.update(0.3);
    CHECK(governor.quality().share < 0.6F);
    const float coarse = governor.quality().share;
    for (int i = 0; i + 1 < QualityGovernor::kLateFrames; ++i)
        governor.update(0.1);
    CHECK(governor.quality().share == coarse);
    governor.update(0.1);
    CHECK(governor.quality().share < coarse);
    for (int i = 0; i < 20; ++i)
        governor.update(0.5);
    CHECK(governor.quality().share > 0.3F);  // there is an end
    for (int i = 0; i < 10 * QualityGovernor::kEasyFrames; ++i)
        governor.update(0.002);
    CHECK(governor.quality().share == 1.0F);
    CHECK(governor.quality().ambientOcclusion);
}

TEST_CASE("quality does not swing: what would be late again is not tried") {
    QualityGovernor governor;
    governor.update(0.3);
    governor.update(0.3);
    const float share = governor.quality().share;
    for (int i = 0; i < 3 * QualityGovernor::kEasyFrames; ++i)
        governor.update(0.028);
    CHECK(governor.quality().share == share);
}
