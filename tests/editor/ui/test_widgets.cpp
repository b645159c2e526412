#include "editor/ui/widgets.hpp"

#include "editor/ui/ui_scale.hpp"
#include "support/catch.hpp"

using namespace lutka::editor;

TEST_CASE("the digits of a slider stand clear of its knob wherever that is") {
    constexpr float width = 150.0F;
    constexpr float text = 40.0F;
    for (const float knob : {8.0F, 40.0F}) {
        for (int i = 0; i <= 100; ++i) {
            const float share = static_cast<float>(i) / 100.0F;
            INFO(knob << " " << share);
            const float at = sliderTextAt(width, text, knob, share, 3.0F);
            const float low = share * (width - knob);
            CHECK((at + text <= low || at >= low + knob));
            CHECK(at >= 0.0F);
            CHECK(at + text <= width);
        }
    }
    CHECK(sliderTextAt(width, text, 8.0F, 0.0F, 3.0F) == 0.5F * (width - text));
}

TEST_CASE("panels have a size that can be read on any monitor") {
    CHECK(uiScaleFor({1.0F, 1080, 290.0F}) == 1.0F);  // 24 inches
    CHECK(uiScaleFor({1.0F, 2160, 340.0F}) == 1.5F);  // 27 inches at 4K
    CHECK(uiScaleFor({1.0F, 2160, 194.0F}) == 2.0F);  // a laptop's 15 inches at 4K
    CHECK(uiScaleFor({1.0F, 2160, 535.0F}) == 1.0F);  // a 43 inch 4K desk
    CHECK(uiScaleFor({1.0F, 2160, 0.0F}) == 2.0F);    // it does not tell its size
    CHECK(uiScaleFor({1.5F, 2160, 340.0F}) == 1.5F);  // what the user has set counts
    CHECK(uiScaleFor({1.0F, 0, 0.0F}) == 1.0F);
    CHECK(uiScaleFor({1.0F, 768, 0.0F}) == 1.0F);
}

TEST_CASE("a window whose size was not asked for grows with its panels, as far as the monitor has room") {
    const auto size = [](float scale, lutka::render::Extent free) { return windowSizeFor({1280, 720}, scale, free); };
    CHECK(size(1.0F, {1920, 1080}).width == 1280);
    CHECK(size(2.0F, {3840, 2160}).width == 2560);
    CHECK(size(2.0F, {3840, 2160}).height == 1440);
    CHECK(size(3.0F, {3840, 2100}).width == 3456);
    CHECK(size(3.0F, {3840, 2100}).height == 1890);
    CHECK(size(2.0F, {1280, 720}).width == 1280);
    CHECK(size(0.75F, {1920, 1080}).height == 720);
}
