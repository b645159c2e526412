// Clips on the command line: played by `simulate` and `render`, taken over by `retarget`.
#include <nlohmann/json.hpp>

#include "render/image.hpp"
#include "support/catch.hpp"
#include "support/command.hpp"
#include "support/zoo.hpp"

using namespace lutka;
using namespace lutka::test;
using Json = nlohmann::json;

TEST_CASE("simulate --clip plays a pass of the clip and reports it") {
    const CommandResult result = lutkaCommand("simulate " + kMannequinArgument + " --clip walk --json");
    REQUIRE(result.code == 0);
    const Json report = Json::parse(result.out);
    CHECK(report["clip"]["clip"] == "walk");
    CHECK(report["clip"]["loop"] == true);
    CHECK(report["quality"].is_null());
    CHECK(report["seconds"].get<double>() == Approx(report["clip"]["length"].get<double>()).margin(0.02));
    const CommandResult slow =
        lutkaCommand("simulate " + kMannequinArgument + " --clip walk@0.5 --clip-speed -0.5 --once --in-place");
    CHECK(slow.code == 0);
    CHECK(slow.out.find("played without physics") != std::string::npos);
}

TEST_CASE("clips that are not there and options that do not go together are wrong usage") {
    CHECK(lutkaCommand("simulate " + kMannequinArgument + " --clip moonwalk").code == 2);
    CHECK(lutkaCommand("simulate " + kMannequinArgument + " --clip walk@99").code == 2);
    CHECK(lutkaCommand("simulate " + kMannequinArgument + " --clip walk --from-clip walk").code == 2);
    CHECK(lutkaCommand("simulate " + kMannequinArgument + " --clip walk --shed some").code == 2);
    CHECK(lutkaCommand("simulate " + kMannequinArgument + " --once").code == 2);
}

TEST_CASE("render --clip draws the clip's moment") {
    const ScratchFolder folder;
    const auto draw = [&](const std::string& moment) {
        const std::string file = folder / "clip.png";
        const CommandResult result = lutkaCommand("render " + kMannequinArgument + " --clip " + moment +
                                                  " --seconds 0 --size 160x120 -o " + file);
        if (result.code == kNoDisplay) return std::optional<render::Image>();
        REQUIRE(result.code == 0);
        auto picture = render::loadPng(file);
        REQUIRE(picture);
        return std::optional(std::move(picture).value());
    };
    const auto first = draw("walk@0.1");
    if (!first) SKIP_TEST("no headless OpenGL context");
    const auto second = draw("walk@0.6");
    REQUIRE(second);
    CHECK(first->rgba != second->rgba);
}

TEST_CASE("retarget writes the clip on the other character and prints its figures") {
    NEEDS_ZOO();
    const ScratchFolder folder;
    const std::string out = folder / "boxing.glb";
    const std::string boxing = shellQuoted(zooFile("bvh_boxing/Boxing_Toes.bvh"));
    const CommandResult result =
        lutkaCommand("retarget " + boxing + " --to " + kMannequinArgument + " --json -o " + out);
    REQUIRE(result.code == 0);
    const Json figures = Json::parse(result.out);
    CHECK(figures["limbDirectionDeg"]["mean"].get<double>() < 3.0);
    CHECK(figures["footSlideCm"]["max"].get<double>() < 1.0);
    CHECK(figures["directionDeg"].contains("leftLowerArm"));
    CHECK(lutkaCommand("simulate " + out + " --clip " + figures["clip"].get<std::string>() + " --seconds 0.1").code ==
          0);
}

TEST_CASE("retarget says what it lacks") {
    const ScratchFolder folder;
    const std::string out = folder / "x.glb";
    const std::string to = " --to " + kMannequinArgument + " -o " + out;
    const CommandResult many = lutkaCommand("retarget " + kMannequinArgument + to);
    CHECK(many.code == 2);
    CHECK(many.err.find("walk") != std::string::npos);
    CHECK(lutkaCommand("retarget " + kMannequinArgument + " --clip fly" + to).code == 2);
    CHECK(lutkaCommand("retarget missing.bvh --clip a" + to).code == 3);
    CHECK(lutkaCommand("retarget " + kMannequinArgument + " --clip walk --to missing.glb -o " + out).code == 3);
    CHECK(lutkaCommand("retarget " + kMannequinArgument + " --clip walk --to " + kMannequinArgument +
                       " -o " LUTKA_ASSETS_DIR "/models/mannequin.glb/x.glb")
              .code == 5);
}

TEST_CASE("a hit goes where it is told to by a word, by a vector, or from ahead") {
    const auto hashOf = [](const std::string& hit) {
        const CommandResult result = lutkaCommand("simulate " + kMannequinArgument +
                                                  " --clip idle --puppet powered --seconds 0.5 --json --hit " + hit);
        REQUIRE(result.code == 0);
        return Json::parse(result.out)["stateHash"].get<std::string>();
    };
    CHECK(hashOf("head@0.2:8:left") == hashOf("head@0.2:8,0,0"));
    CHECK(hashOf("head@0.2:8:0,3,0") == hashOf("head@0.2:8:up"));
    CHECK(hashOf("head@0.2:8") == hashOf("head@0.2:8:back"));
    CHECK(hashOf("head@0.2:8") != hashOf("head@0.2:8:ahead"));
    for (const char* hit : {"head@0.2:8:nowhere", "head@0.2:8:0,0,0", "head@0.2:8,0,0:up", "@0.2:8", "head@0.2"})
        CHECK(lutkaCommand("simulate " + kMannequinArgument + " --clip idle --puppet weak --hit " + hit).code == 2);
}

TEST_CASE("joints that carry gravity sag less") {
    const auto offOf = [](const std::string& more) {
        const CommandResult result =
            lutkaCommand("simulate " + kMannequinArgument + " --clip idle --puppet weak --seconds 2 --json" + more);
        REQUIRE(result.code == 0);
        return Json::parse(result.out)["puppet"]["trackingErrorDeg"]["rms"].get<double>();
    };
    CHECK(offOf(" --carry-gravity") < 0.5 * offOf(""));
}

TEST_CASE("simulate --puppet follows the clip with muscles, is hit, and reports how closely") {
    const std::string walk = "simulate " + kMannequinArgument + " --clip walk --puppet ";
    const CommandResult plain = lutkaCommand(walk + "powered --seconds 2 --json");
    REQUIRE(plain.code == 0);
    const Json report = Json::parse(plain.out)["puppet"];
    CHECK(report["clip"] == "walk");
    CHECK(report["trackingErrorDeg"]["rms"].get<double>() < 2.0);
    CHECK(report["knockOuts"] == 0);
    REQUIRE(report["trackingErrorDeg"]["joints"].size() == 15);
    const Json& worst = report["trackingErrorDeg"]["joints"][report["trackingErrorDeg"]["worst"].get<std::string>()];
    CHECK(worst["max"] == report["trackingErrorDeg"]["max"]);
    CHECK(worst["rms"].get<double>() > report["trackingErrorDeg"]["rms"].get<double>());
    CHECK(report["pinImpulseNs"].get<double>() > 100.0);
    const CommandResult hit = lutkaCommand(walk + "powered --seconds 2 --hit leftLowerArm@0.5:8 --json");
    REQUIRE(hit.code == 0);
    CHECK(Json::parse(hit.out)["puppet"]["trackingErrorDeg"]["max"].get<double>() > 15.0);
    const CommandResult out =
        lutkaCommand(walk + "powered --seconds 3 --hit hips@0.5:0,0,600 --hit upperChest@0.5:400");
    CHECK(out.code == 0);
    CHECK(out.out.find("knocked out") != std::string::npos);
    CHECK(report["footSlideM"].get<double>() < 0.05);
    const CommandResult legs = lutkaCommand(walk + "limp --kinematic hips,leg --seconds 2 --json");
    REQUIRE(legs.code == 0);
    CHECK(Json::parse(legs.out)["puppet"]["kinematicBodies"].get<int>() == 7);
    CHECK(Json::parse(legs.out)["puppet"]["ledErrorM"].get<double>() < 0.002);
    CHECK(lutkaCommand(walk + "weak --kinematic tentacle").code == 2);
    CHECK(lutkaCommand(walk + "weak --kinematic leg:2").code == 2);
    CHECK(lutkaCommand(walk + "profile --seconds 0.1").code == 0);
    CHECK(lutkaCommand(walk + "mighty").code == 2);
    CHECK(lutkaCommand(walk + "weak --hit elbow@1:3").code == 2);
    CHECK(lutkaCommand(walk + "weak --hit head@1").code == 2);
    const CommandResult none = lutkaCommand(walk + "weak --hit leftToes@1:5");
    CHECK(none.code == 2);
    CHECK(none.err.find("leftFoot") != std::string::npos);
    CHECK(lutkaCommand("simulate " + kMannequinArgument + " --puppet weak").code == 2);
}
