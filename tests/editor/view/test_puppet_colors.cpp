#include <cstdlib>

#include "editor/view/describe_frame.hpp"
#include "support/catch.hpp"

using namespace lutka;
using namespace lutka::editor;

namespace {

int apart(const render::Color& a, const render::Color& b) {
    return std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b);
}

}  // namespace

TEST_CASE("what puppets' colours mean is told, and no two of them look alike") {
    const auto target = targetLegend();
    const auto strength = strengthLegend();
    for (const render::LegendEntry& error : target) {
        for (const render::LegendEntry& force : strength) {
            INFO(error.text << " and " << force.text);
            CHECK(apart(error.color, force.color) > 120);
        }
    }
    CHECK(apart(target[0].color, target[1].color) > 120);
    CHECK(apart(strength[0].color, strength[1].color) > 120);
}
