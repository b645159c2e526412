#pragma once

#include <filesystem>
#include <string>

#include "render/image.hpp"
#include "support/catch.hpp"

namespace lutka::test {

/// How far a picture may be from its baseline: rasterisers differ by rounding, more so along edges.
struct GoldenTolerance {
    int channel = 10;              ///< A pixel differs when any channel is off by more, of 255.
    double differingShare = 0.01;  ///< Of all pixels.
    double meanError = 0.5;        ///< Over all channels, of 255.
};

/// Compares with tests/golden/<name>.png. A picture that differs, or has no baseline yet, is written to the folder
/// `golden` beside the program under test (with the differences marked), and the test fails: look at it, then copy it.
inline void checkGolden(const render::Image& image, const std::string& name, const GoldenTolerance& tolerance = {}) {
    namespace fs = std::filesystem;
    const fs::path baseline = fs::path(LUTKA_TESTS_DIR) / "golden" / (name + ".png");
    const fs::path written = fs::path(LUTKA_BINARY).parent_path() / "golden" / (name + ".png");
    const Result<render::Image> expected = render::loadPng(baseline);
    if (!expected) {
        REQUIRE(render::savePng(image, written).ok());
        FAIL("there is no baseline " + baseline.string() + "; the picture was written to " + written.string());
    }
    const render::ImageDifference difference = render::compareImages(image, expected.value(), tolerance.channel);
    const bool same = difference.sameSize && difference.differingShare <= tolerance.differingShare &&
                      difference.meanError <= tolerance.meanError;
    if (!same) {
        REQUIRE(render::savePng(image, written).ok());
        if (difference.sameSize) {
            const render::Image marked = render::differenceImage(image, expected.value(), tolerance.channel);
            REQUIRE(render::savePng(marked, written.parent_path() / (name + "_difference.png")).ok());
        }
    }
    INFO(name << ": " << 100.0 * difference.differingShare << " % of the pixels differ, mean error "
              << difference.meanError << ", the picture was written to " << written);
    CHECK(difference.sameSize);
    CHECK(difference.differingShare <= tolerance.differingShare);
    CHECK(difference.meanError <= tolerance.meanError);
}

}  // namespace lutka::test
