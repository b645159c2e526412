// Pictures of `lutka render` against baselines in tests/golden, looked at before they were committed. The moments lie
// in the fall, where no solver has had much to say yet, but for those that need a contact.

#include "render/gl/golden.hpp"
#include "support/catch.hpp"
#include "support/command.hpp"
#include "support/zoo.hpp"

using namespace lutka;
using namespace lutka::test;

namespace {

void checkPicture(const std::string& arguments, const std::string& name, const GoldenTolerance& tolerance = {}) {
    INFO(arguments);
    const ScratchFolder folder;
    const std::string file = folder / "picture.png";
    const CommandResult result =
        lutkaCommand("render " + arguments + " --follow --size 320x240 -o " + shellQuoted(file));
    INFO(result.err);
    REQUIRE(result.code == 0);
    const Result<render::Image> picture = render::loadPng(file);
    REQUIRE(picture);
    checkGolden(picture.value(), name, tolerance);
}

bool drawsHere() {
    const ScratchFolder folder;
    return lutkaCommand("render " + kMannequinArgument + " --seconds 0 --size 16x16 -o " + (folder / "probe.png"))
               .code != kNoDisplay;
}

}  // namespace

#define NEEDS_DRAWING() \
    if (!drawsHere()) SKIP_TEST("no headless OpenGL context")

TEST_CASE("each debug layer looks as it did when it was looked at") {
    NEEDS_DRAWING();
    for (const char* layer :
         {"capsules", "solids", "skeleton", "joints", "limits", "velocities", "com", "aabbs", "sleep", "bullet"}) {
        const std::string solver = std::string(layer) == "bullet" ? " --solver bullet" : "";
        checkPicture(kMannequinArgument + " --seconds 0.3 --no-legend --debug " + layer + solver,
                     std::string("layer_") + layer);
    }
    // On the floor the pose is the solver's: its improvements move it.
    checkPicture(kMannequinArgument + " --seconds 0.9 --opacity 0.3 --debug contacts,velocities", "layer_contacts",
                 {10, 0.05, 2.0});
}

TEST_CASE("three models of the zoo look in their fall as they did when they were looked at") {
    NEEDS_DRAWING();
    NEEDS_ZOO();
    for (const char* model :
         {"cesium_man_glb/CesiumMan.glb", "kaykit_rogue/Rogue_Hooded.glb", "rocketbox_male/Male_Adult_17.fbx"}) {
        const std::string path = zooFile(model).string();
        const std::string stem = zooFile(model).stem().string();
        checkPicture(shellQuoted(path) + " --seed 3 --seconds 0.35", "fall_" + stem, {10, 0.02, 1.0});
    }
}

TEST_CASE("a picture of the last moment is that of the film: as near to a doll that lies") {
    NEEDS_DRAWING();
    const ScratchFolder folder;
    const std::string of = "render " + kMannequinArgument + " --seconds 2.5 --size 192x108 -o ";
    REQUIRE(lutkaCommand(of + (folder / "last.png")).code == 0);
    REQUIRE(lutkaCommand(of + (folder / "film.png") + " --frames --fps 60").code == 0);
    const Result<render::Image> last = render::loadPng(folder / "last.png");
    const Result<render::Image> film = render::loadPng(folder / "film_0150.png");
    const Result<render::Image> start = render::loadPng(folder / "film_0000.png");
    REQUIRE(last);
    REQUIRE(film);
    REQUIRE(start);
    constexpr int channel = 24;
    CHECK(render::compareImages(last.value(), film.value(), channel).differingShare < 0.02);
    CHECK(render::compareImages(last.value(), start.value(), channel).differingShare > 0.02);
}

TEST_CASE("a panorama lights the figure and is seen behind it, and a broken one ends with 3") {
    NEEDS_DRAWING();
    const ScratchFolder folder;
    // Orange from the left, blue from the right, dark below.
    std::string bytes = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 32 +X 64\n";
    const auto put = [&](int r, int g, int b) {
        for (const int channel : {r, g, b, 129})
            bytes.push_back(static_cast<char>(channel));
    };
    for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 64; ++x) {
            if (y >= 18) {
                put(30, 28, 26);
            } else if (x < 32) {
                put(240, 130, 40);
            } else {
                put(50, 110, 240);
            }
        }
    }
    const std::string sky = folder / "sky.hdr";
    std::ofstream(sky, std::ios::binary) << bytes;
    const std::string still = kMannequinArgument + " --seconds 0.1 --sky " + shellQuoted(sky);
    checkPicture(still + " --sky-background", "sky_panorama");
    std::ofstream(sky, std::ios::binary) << bytes.substr(0, 900);
    const CommandResult broken = lutkaCommand("render " + still + " -o " + shellQuoted(folder / "x.png"));
    CHECK(broken.code == 3);
    CHECK(broken.err.find("sky.hdr") != std::string::npos);
    CHECK(broken.err.find("cut off") != std::string::npos);
}

TEST_CASE("the legend is in the picture of a debug layer unless it is not wanted") {
    NEEDS_DRAWING();
    const ScratchFolder folder;
    const auto paint = [&](const std::string& more) {
        const std::string file = folder / "picture.png";
        const CommandResult result = lutkaCommand("render " + kMannequinArgument + " --seconds 0.1 --size 320x240 -o " +
                                                  shellQuoted(file) + more);
        return result.code == 0 ? render::loadPng(file).value() : render::Image({320, 240}, {});
    };
    const render::Image with = paint(" --debug aabbs");
    const render::Image without = paint(" --debug aabbs --no-legend");
    const render::ImageDifference difference = render::compareImages(with, without, 8);
    if (difference.maxError == 0 && with.at(0, 0) == render::Color{}) return;  // no OpenGL
    CHECK(difference.differingShare > 0.01);
    for (int y = 60; y < 240; ++y)
        CHECK(with.at(200, y) == without.at(200, y));
}

TEST_CASE("what is far from the camera that draws is spared unless an eye is given") {
    NEEDS_DRAWING();
    const ScratchFolder folder;
    const auto frozen = [&](const std::string& options) -> int {
        const CommandResult result = lutkaCommand(
            "render " + kMannequinArgument +
            " --scene spread --count 4 --seconds 0.1 --solver crowd --shed frozen@15 " + options + " --size 64x48 -o " +
            shellQuoted(folder / "p.png") + " --report " + shellQuoted(folder / "r.json"));
        if (result.code == 6) return -1;
        INFO(result.err);
        REQUIRE(result.code == 0);
        const std::string report = fileText(folder / "r.json");
        const std::string key = "\"frozen\": ";
        const std::size_t at = report.find(key);
        REQUIRE(at != std::string::npos);
        return std::stoi(report.substr(at + key.size()));
    };
    const int near = frozen("--distance 6");
    if (near < 0) return;
    CHECK(near == 0);
    CHECK(frozen("--distance 60") == 4);
    CHECK(frozen("--distance 60 --eye 0,1,0") == 0);
    CHECK(frozen("--distance 6 --eye 0,1,90") == 4);
}

TEST_CASE("a driver that gives up in the middle of a film ends the command with its reason and leaves no film") {
    NEEDS_DRAWING();
    NEEDS_PROGRAM("ffmpeg");
    const ScratchFolder folder;
    const CommandResult result = runCommand("LUTKA_GL_LOSE=3 '" LUTKA_BINARY "' render " + kMannequinArgument +
                                            " --seconds 0.2 --size 64x64 -o " + (folder / "film.mp4"));
    CHECK(result.code == kNoDisplay);
    CHECK_THAT(result.err, Catch::Contains("gave up"));
    CHECK(filesIn(folder.path) == 0);
}

TEST_CASE("a picture that no memory holds is refused before the fall") {
    NEEDS_DRAWING();
    const ScratchFolder folder;
    const CommandResult result =
        lutkaCommand("render " + kMannequinArgument + " --size 16384x16384 -o " + (folder / "large.png"));
    CHECK(result.code == 2);
    CHECK_THAT(result.err, Catch::Contains("million pixels"));
    CHECK(filesIn(folder.path) == 0);
}

TEST_CASE("a driver that has OpenGL 3.3 and nothing beyond draws the same picture") {
    NEEDS_DRAWING();
    const ScratchFolder folder;
    const auto picture = [&](const std::string& name, const std::string& environment) {
        const CommandResult result =
            runCommand(environment + " '" LUTKA_BINARY "' render " + kMannequinArgument +
                       " --seconds 0.5 --size 160x120 --debug joints,limits -o " + (folder / name));
        INFO(result.err);
        REQUIRE(result.code == 0);
        const Result<render::Image> image = render::loadPng(folder / name);
        REQUIRE(image);
        return image.value();
    };
    // Mesa leaves out what came after, and the extensions that are named.
    const render::Image least =
        picture("least.png",
                "MESA_GL_VERSION_OVERRIDE=3.3 MESA_GLSL_VERSION_OVERRIDE=330 MESA_EXTENSION_OVERRIDE='-GL_KHR_debug "
                "-GL_ARB_buffer_storage -GL_ARB_texture_storage -GL_ARB_direct_state_access -GL_KHR_robustness'");
    CHECK(render::compareImages(least, picture("all.png", ""), 2).differingShare < 0.001);
}
