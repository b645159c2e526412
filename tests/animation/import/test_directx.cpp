// Text files of DirectX's .x.

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "animation/import/checks.hpp"
#include "animation/import/gltf_file.hpp"
#include "support/catch.hpp"

using namespace lutka;
using namespace lutka::animation;
using namespace lutka::test;

namespace {

// A triangle on the upper of two frames, which moves up by 0.1 from key to key.
std::string movingTriangle(const std::vector<int>& ticks, const std::string& rate) {
    const auto frame = [](const std::string& name, const std::string& height) {
        return "Frame " + name + " {\n FrameTransformMatrix {\n  1.0,0.0,0.0,0.0,0.0,1.0,0.0,0.0,0.0,0.0,1.0,0.0,0.0," +
               height + ",0.0,1.0;;\n }\n";
    };
    std::ostringstream keys;
    for (std::size_t i = 0; i < ticks.size(); ++i)
        keys << ticks[i] << ";3;0.0," << 1.05 + 0.1 * static_cast<double>(i) << ",0.0;;"
             << (i + 1 < ticks.size() ? "," : ";") << "\n";
    return "xof 0303txt 0032\n" + rate + frame("Low", "0.0") + frame("High", "1.0") +
           " Mesh {\n  3;\n  0.0;0.0;0.0;,\n  0.5;0.0;0.0;,\n  0.0;0.8;0.0;;\n  1;\n  3;0,1,2;;\n }\n}\n}\n"
           "AnimationSet Rise {\n Animation {\n  {High}\n  AnimationKey {\n   2;\n   " +
           std::to_string(ticks.size()) + ";\n" + keys.str() + "  }\n }\n}\n";
}

float secondsOf(const std::vector<int>& ticks, const std::string& rate = "") {
    const TemporaryFolder folder;
    std::ofstream(folder / "rise.x") << movingTriangle(ticks, rate);
    const Character character = imported(folder / "rise.x");
    REQUIRE(character.clips.size() == 1);
    const Clip& clip = character.clips[0];
    return static_cast<float>(clip.frameCount - 1) / clip.framesPerSecond;
}

}  // namespace

TEST_CASE("ticks of a .x that does not say how long they are") {
    // Frames of 25 a second, as exporters write them.
    CHECK(secondsOf({0, 1, 2, 3, 50}) == Approx(2.0));
    // DirectX's own, of which 4800 are a second: 60 and 30 keys in one.
    CHECK(secondsOf({0, 80, 160, 240, 960}) == Approx(0.2));
    CHECK(secondsOf({0, 160, 320, 4800}) == Approx(1.0));
    // Two keys tell nothing of it.
    CHECK(secondsOf({0, 100}) == Approx(4.0));
    CHECK(secondsOf({0, 80, 160, 240}, "AnimTicksPerSecond { 80; }\n") == Approx(3.0));
}
