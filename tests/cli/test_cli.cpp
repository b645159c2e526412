#include <algorithm>
#include <csignal>

#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>
#include <string>

#include "support/catch.hpp"
#include "support/command.hpp"
#include "support/zoo.hpp"

using namespace lutka::test;
using Json = nlohmann::json;
namespace fs = std::filesystem;

namespace {

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("every command explains itself") {
    const CommandResult all = lutkaCommand("--help");
    CHECK(all.code == 0);
    CHECK(contains(all.out, "Exit codes"));
    for (const char* command : {"inspect", "map", "build", "simulate", "render"}) {
        INFO(command);
        const CommandResult help = lutkaCommand(std::string(command) + " --help");
        CHECK(help.code == 0);
        CHECK(contains(help.out, "MODEL"));
        CHECK(contains(all.out, command));
    }
}

TEST_CASE("wrong usage ends with 2 and says what is wrong") {
    CHECK(lutkaCommand("").code == 2);
    CHECK(lutkaCommand("dance").code == 2);
    CHECK(lutkaCommand("map").code == 2);
    CHECK(lutkaCommand("simulate " + kMannequinArgument + " --count 0").code == 2);
    const CommandResult scene = lutkaCommand("simulate " + kMannequinArgument + " --scene dropp");
    CHECK(scene.code == 2);
    CHECK(contains(scene.err, "stairs"));
    CHECK(lutkaCommand("render " + kMannequinArgument + " -o x.png --size 10by10").code == 2);
    CHECK(lutkaCommand("simulate " + kMannequinArgument + " --from-clip moonwalk").code == 2);
}

TEST_CASE("a file that is missing, empty or no model ends with 3 and is named") {
    const ScratchFolder folder;
    std::ofstream(folder / "empty.glb").flush();
    std::ofstream(folder / "words.fbx") << "not a model";
    for (const char* name : {"missing.glb", "empty.glb", "words.fbx"}) {
        INFO(name);
        const CommandResult result = lutkaCommand("inspect " + shellQuoted(folder / name));
        CHECK(result.code == 3);
        CHECK(contains(result.err, name));
        CHECK(result.out.empty());
    }
    const CommandResult map = lutkaCommand("map --json " + shellQuoted(folder / "missing.glb"));
    CHECK(map.code == 3);
    CHECK(Json::parse(map.out)["humanoid"] == false);
}

TEST_CASE("inspect shows the mannequin's joints, meshes and clips") {
    const CommandResult text = lutkaCommand("inspect " + kMannequinArgument);
    REQUIRE(text.code == 0);
    CHECK(contains(text.out, "leftUpperArm"));
    CHECK(contains(text.out, "walk"));
    const Json json = Json::parse(lutkaCommand("inspect --json " + kMannequinArgument).out);
    CHECK(json["joints"].size() >= 45);
    CHECK(json["meshes"].size() >= 1);
    CHECK(json["clips"].size() == 9);
    CHECK(json["units"]["metresPerFileUnit"] == 1.0);
}

TEST_CASE("map binds every joint of the mannequin to the role that it is named after") {
    const CommandResult result = lutkaCommand("map --json " + kMannequinArgument);
    REQUIRE(result.code == 0);
    const Json json = Json::parse(result.out);
    CHECK(json["humanoid"] == true);
    CHECK(json["missing"].empty());
    CHECK(json["roles"].size() == 22);
    for (const auto& [role, binding] : json["roles"].items()) {
        CHECK(binding["joint"] == role);
        CHECK_FALSE(binding["reason"].get<std::string>().empty());
    }
}

TEST_CASE("a profile that was written and read again gives the same fall to the bit") {
    const ScratchFolder folder;
    const std::string profile = folder / "mannequin.ragdoll.json";
    REQUIRE(lutkaCommand("build " + kMannequinArgument + " -o " + profile).code == 0);
    const std::string simulate = "simulate " + kMannequinArgument + " --seconds 1 --json";
    const Json fitted = Json::parse(lutkaCommand(simulate).out);
    const Json read = Json::parse(lutkaCommand(simulate + " --profile " + profile).out);
    CHECK(fitted["stateHash"] == read["stateHash"]);
    CHECK(fitted["bodies"] == 16);
}

TEST_CASE("a profile with faults ends with 3 and lists them all") {
    const ScratchFolder folder;
    const std::string profile = folder / "broken.ragdoll.json";
    REQUIRE(lutkaCommand("build " + kMannequinArgument + " -o " + profile).code == 0);
    Json json = Json::parse(fileText(profile));
    json["bodies"][3]["massKg"] = -1;
    json["bodies"][5]["colour"] = "red";
    std::ofstream(profile) << json.dump();
    const CommandResult result = lutkaCommand("simulate " + kMannequinArgument + " --profile " + profile);
    CHECK(result.code == 3);
    CHECK(contains(result.err, "/bodies/3"));
    CHECK(contains(result.err, "colour"));
}

TEST_CASE("simulate writes the baked clip, the last mesh and the report") {
    const ScratchFolder folder;
    const CommandResult result =
        lutkaCommand("simulate " + kMannequinArgument + " --seconds 1 --out " + (folder / "fall.glb") + " --mesh-out " +
                     (folder / "last.obj") + " --report " + (folder / "report.json"));
    REQUIRE(result.code == 0);
    const Json report = Json::parse(fileText(folder / "report.json"));
    CHECK(report["steps"] == 60);
    CHECK(report["quality"]["nonFinite"] == 0);
    CHECK(fileText(folder / "last.obj").substr(0, 200).find("v ") != std::string::npos);
    const Json baked = Json::parse(lutkaCommand("inspect --json " + (folder / "fall.glb")).out);
    CHECK(baked["clips"][0]["seconds"].get<double>() == Approx(1.0).margin(0.02));
}

TEST_CASE("bodies are held by their names, and an unknown one is wrong usage that lists them") {
    const ScratchFolder folder;
    const std::string common = "simulate " + kMannequinArgument + " --seconds 3 --out " + (folder / "fall.glb");
    const auto highestVertex = [&](const std::string& options) {
        REQUIRE(lutkaCommand(common + " --mesh-out " + (folder / "last.obj") + options).code == 0);
        std::istringstream in(fileText(folder / "last.obj"));
        float highest = 0.0F;
        for (std::string line; std::getline(in, line);) {
            std::istringstream words(line);
            std::string kind;
            float x = 0.0F;
            float y = 0.0F;
            if (words >> kind >> x >> y && kind == "v") highest = std::max(highest, y);
        }
        return highest;
    };
    CHECK(highestVertex(" --hold head,rightHand") > 1.2F);
    CHECK(highestVertex(" --hold ' head , rightHand'") > 1.2F);
    // The list ends with its word.
    CHECK(lutkaCommand("simulate --seconds 0.1 --hold head,rightHand " + kMannequinArgument).code == 0);
    CHECK(highestVertex("") < 1.0F);
    const CommandResult unknown = lutkaCommand(common + " --hold tail");
    CHECK(unknown.code == 2);
    CHECK(contains(unknown.err, "'tail'"));
    CHECK(contains(unknown.err, "rightHand"));
}

TEST_CASE("an output that can't be written ends with 5 and leaves nothing") {
    const ScratchFolder folder;
    std::ofstream(folder / "file") << "in the way";
    const std::string target = folder / "file/report.json";
    const CommandResult result = lutkaCommand("simulate " + kMannequinArgument + " --seconds 0.1 --report " + target);
    CHECK(result.code == 5);
    CHECK(contains(result.err, "report.json"));
    CHECK(fileText(folder / "file") == "in the way");
}

TEST_CASE("what is not a humanoid is refused with 3 and a reason") {
    NEEDS_ZOO();
    for (const char* model : {"fox/Fox.glb", "webxr_hand/hand_left.glb", "nonhum_static_mannequin/m2m_mannequin.glb",
                              "quat_trex/dinosaurs_pack_Trex.glb", "nonhum_velociraptor/q_velociraptor.fbx"}) {
        INFO(model);
        const CommandResult result = lutkaCommand("map --json " + shellQuoted(zooFile(model)));
        CHECK(result.code == 3);
        const Json json = Json::parse(result.out);
        CHECK(json["humanoid"] == false);
        REQUIRE_FALSE(json["warnings"].empty());
        CHECK(json["warnings"][0].get<std::string>().size() > 10);
        CHECK(lutkaCommand("simulate " + shellQuoted(zooFile(model))).code == 3);
    }
}

TEST_CASE("every humanoid of the zoo falls, stays finite and comes to rest") {
    NEEDS_ZOO();
    int humanoids = 0;
    int resting = 0;
    for (const auto& entry : fs::directory_iterator(LUTKA_ZOO_DIR)) {
        const fs::path truthFile = entry.path() / "truth.json";
        if (!fs::exists(truthFile)) continue;
        const Json truth = Json::parse(fileText(truthFile));
        if (truth["humanoid"] != true) continue;
        const fs::path model = entry.path() / truth["file"].get<std::string>();
        // This copy lost every CR of its CR-LF pairs on its way: 122 bytes are missing from its own count.
        if (model.filename() == "ninja.b3d") continue;
        INFO(model.filename().string());
        const CommandResult result = lutkaCommand("simulate --json --seconds 8 " + shellQuoted(model));
        CHECK(result.code == 0);
        if (result.code != 0) continue;
        const Json quality = Json::parse(result.out)["quality"];
        ++humanoids;
        CHECK(quality["nonFinite"] == 0);
        CHECK(quality["jointSeparationM"]["max"].get<double>() < 0.03);
        CHECK(quality["residualSpeedMps"].get<double>() < 0.05);
        if (!quality["settleSeconds"].is_null()) ++resting;
    }
    CHECK(humanoids >= 20);
    CHECK(resting >= humanoids * 9 / 10);
}

TEST_CASE("check finds nothing wrong with the mannequin and an error in a profile with a planted fault") {
    const CommandResult sound = lutkaCommand("check --json " + kMannequinArgument);
    REQUIRE(sound.code == 0);
    const Json good = Json::parse(sound.out);
    CHECK(good["score"].get<double>() > 90);
    CHECK(good["drops"].size() == 3);
    const Json walk = good["walk"];
    CHECK(walk["trackingErrorDeg"]["rms"].get<double>() < 2.0);
    CHECK(walk["trackingErrorDeg"]["joints"].size() == 15);
    CHECK(walk["rootErrorM"].get<double>() < 0.02);
    CHECK(walk["recoverySeconds"].get<double>() < 0.5);

    const ScratchFolder folder;
    const std::string profile = folder / "faulty.ragdoll.json";
    const std::string fixed = folder / "fixed.ragdoll.json";
    REQUIRE(lutkaCommand("build " + kMannequinArgument + " -o " + profile).code == 0);
    Json json = Json::parse(fileText(profile));
    for (Json& constraint : json["constraints"]) {
        if (constraint["child"] == "leftLowerArm") constraint["hinge"] = {{"lower", 0.0}, {"upper", 0.1}};
    }
    std::ofstream(profile) << json.dump();
    const CommandResult faulty = lutkaCommand("check --json " + kMannequinArgument + " --profile " + profile);
    CHECK(faulty.code == 4);
    CHECK(contains(faulty.out, "bind-outside-limits"));
    const CommandResult mended =
        lutkaCommand("check --json " + kMannequinArgument + " --profile " + profile + " --fix " + fixed);
    CHECK(mended.code == 0);
    CHECK(lutkaCommand("check " + kMannequinArgument + " --profile " + fixed).code == 0);
}

TEST_CASE("bench prints our time beside stock Bullet's, with the quality of both") {
    const CommandResult result = lutkaCommand("bench --json --count 1,2 --scene spread --steps 20");
    REQUIRE(result.code == 0);
    const Json json = Json::parse(result.out);
    REQUIRE(json["cases"].size() == 2);
    for (const Json& one : json["cases"]) {
        CHECK(one["speedup"].get<double>() > 0);
        CHECK(one["realTimeDollsPerCore"].get<double>() == Approx(one["dollStepsPerSecond"].get<double>() / 60.0));
        CHECK(one["stockMsPerStep"]["p50"].get<double>() > 0);
        CHECK(one["quality"].contains("jointSeparationM"));
        CHECK(one["stockQuality"].contains("jointSeparationM"));
    }
}

TEST_CASE("build tells limits from the bind pose: a knee bends one way, and both knees alike") {
    const CommandResult result = lutkaCommand("build " + kMannequinArgument);
    REQUIRE(result.code == 0);
    for (const char* knee : {"leftLowerLeg ", "rightLowerLeg "}) {
        std::smatch range;
        const std::string line = result.out.substr(result.out.find(knee));
        REQUIRE(std::regex_search(line, range, std::regex("hinge (-?[0-9]+)\\.\\.([0-9]+) deg")));
        CHECK(std::stoi(range[1]) >= -25);
        CHECK(std::stoi(range[2]) >= 110);
    }
}

TEST_CASE("build shows the limits that the clips ask for beside the anatomy's") {
    const CommandResult result = lutkaCommand("build " + kMannequinArgument + " --limits-from-clips fit");
    REQUIRE(result.code == 0);
    CHECK(contains(result.out, "ANATOMY"));
    CHECK(contains(result.out, "CLIPS"));
}

TEST_CASE("an output never destroys an input or another output") {
    const ScratchFolder folder;
    const std::string model = folder / "own.glb";
    fs::copy_file(LUTKA_ASSETS_DIR "/models/mannequin.glb", model);
    const std::string before = fileText(model);
    CHECK(lutkaCommand("simulate " + model + " --seconds 0.1 --out " + model).code == 2);
    CHECK(fileText(model) == before);
    const std::string same = folder / "same.json";
    CHECK(lutkaCommand("simulate " + model + " --seconds 0.1 --report " + same + " --record " + same).code == 2);
    CHECK(lutkaCommand("simulate " + model + " --seconds 0.1 --out " + (folder / "fall.fbx")).code == 2);
    CHECK(lutkaCommand("render " + model + " --seconds 0.1 -o " + (folder / "fall.jpg")).code == 2);
    CHECK(std::distance(fs::directory_iterator(folder.path), fs::directory_iterator()) == 1);
}

TEST_CASE("numbers that are not finite or out of range are wrong usage") {
    for (const char* options : {"--seconds nan", "--mass inf", "--mass -1", "--scale 0", "--seed -1", "--seed 1e3",
                                "--seed 99999999999999999999999", "--masses heavy"}) {
        INFO(options);
        CHECK(lutkaCommand("simulate " + kMannequinArgument + " --seconds 0.1 " + options).code == 2);
    }
}

TEST_CASE("dolls far from the eye are spared and the report says how many") {
    const ScratchFolder folder;
    const CommandResult result =
        lutkaCommand("simulate " + kMannequinArgument +
                     " --scene spread --count 6 --seconds 0.2 --solver crowd --shed lod@0,frozen@3"
                     " --eye 0,1,0 --report " +
                     (folder / "r.json"));
    CHECK(result.code == 0);
    const std::string report = fileText(folder / "r.json");
    CHECK(contains(report, "\"quality\": null"));
    CHECK(contains(report, "\"lod\": 6"));
    CHECK_FALSE(contains(report, "\"frozen\": 0"));
    CHECK(contains(result.out + result.err, "spared at the end"));
    CHECK(lutkaCommand("simulate " + kMannequinArgument + " --shed ice@3").code == 2);
    CHECK(lutkaCommand("simulate " + kMannequinArgument + " --shed lod@3 --eye 1,2").code == 2);
}

TEST_CASE("the mannequin falls within every bound on the crowd solver") {
    int slow = 0;
    for (const std::string scene : {"drop", "stairs", "throw"}) {
        for (int seed = 0; seed < 6; ++seed) {
            INFO(scene << ", seed " << seed);
            const CommandResult result =
                lutkaCommand("simulate " + kMannequinArgument + " --solver crowd --scene " + scene + " --seed " +
                             std::to_string(seed) + " --seconds 12 --json");
            REQUIRE(result.code == 0);
            const Json json = Json::parse(result.out);
            const Json& quality = json["quality"];
            CHECK(quality["jointSeparationM"]["max"].get<double>() < 0.010);
            CHECK(quality["jointSeparationM"]["p99"].get<double>() < 0.002);
            CHECK(quality["limitViolationDeg"]["p99"].get<double>() < 3.0);
            CHECK(quality["floorPenetrationM"]["max"].get<double>() < 0.010);
            CHECK(quality["energyGrowthJ"].get<double>() < 0.03 * quality["initialEnergyJ"].get<double>());
            REQUIRE(quality["settleSeconds"].is_number());
            slow += quality["settleSeconds"].get<double>() >= 6.0 ? 1 : 0;
            CHECK(quality["residualSpeedMps"].get<double>() < 0.01);
        }
    }
    // Most lie within 3 s; one that sits upright or hangs across steps may take its time.
    CHECK(slow <= 1);
}

TEST_CASE("a stdout that can't be written ends with 5") {
    if (!fs::exists("/dev/full")) SKIP_TEST("this system has no /dev/full");
    const CommandResult result =
        runCommand("sh -c \"'" LUTKA_BINARY "' map --json " LUTKA_ASSETS_DIR "/models/mannequin.glb >/dev/full\"");
    CHECK(result.code == 5);
}

TEST_CASE("an FBX that is cut off ends with 3") {
    NEEDS_ZOO();
    const ScratchFolder folder;
    std::string bytes = fileText(zooFile("rocketbox_male/Male_Adult_17.fbx"));
    REQUIRE(bytes.size() > 401604);
    bytes.resize(bytes.size() / 2);
    std::ofstream(folder / "damaged.fbx", std::ios::binary) << bytes;
    const CommandResult result = lutkaCommand("map " + (folder / "damaged.fbx"));
    CHECK(result.code == 3);
    CHECK(contains(result.err, "damaged.fbx"));
}

TEST_CASE("an interrupted video leaves nothing behind") {
    NEEDS_PROGRAM("ffmpeg");
    const ScratchFolder folder;
    const CommandResult result = runCommand("timeout --signal=INT 3 '" LUTKA_BINARY "' render " + kMannequinArgument +
                                            " --seconds 600 --size 160x120 -o " + (folder / "long.mp4"));
    NEEDS_DISPLAY_OF(result);
    CHECK(result.code == 124);  // timeout's own word for having sent the signal
    CHECK(fs::is_empty(folder.path));
}

TEST_CASE("an interrupted video leaves nothing behind, file or process, while the encoder hangs") {
    const ScratchFolder folder;
    // Its frames are never taken, so that nothing looks at the flag: the time that is left for a polite end runs out.
    const std::string encoder = folder / "ffmpeg";
    const std::string process = folder / "pid";
    std::ofstream(encoder) << "#!/bin/sh\necho $$ > '" << process << "'\nexec sleep 600\n";
    fs::permissions(encoder, fs::perms::owner_all);
    fs::create_directory(folder / "out");
    const CommandResult result =
        runCommand("sh -c \"PATH='" + folder.path.string() + "':\\$PATH '" LUTKA_BINARY "' render " +
                   kMannequinArgument + " --seconds 600 --size 640x480 -o '" + (folder / "out/long.mp4") +
                   "' & p=\\$!; while kill -0 \\$p 2>/dev/null && [ ! -s '" + process +
                   "' ]; do sleep 0.05; done; kill -TERM \\$p 2>/dev/null; wait \\$p\"");
    NEEDS_DISPLAY_OF(result);
    CHECK(result.code == 128 + SIGTERM);
    CHECK(fs::is_empty(folder / "out"));
    CHECK(runCommand("sh -c \"kill -0 \\$(cat '" + process + "')\"").code != 0);
}

TEST_CASE("an interrupt that comes several times at once is one") {
    NEEDS_PROGRAM("ffmpeg");
    const ScratchFolder folder;
    // A picture of this size takes longer than the two are apart.
    const CommandResult result = runCommand(
        "sh -c \"'" LUTKA_BINARY "' render " + kMannequinArgument + " --seconds 600 --size 1280x720 -o " +
        (folder / "long.mp4") + " & p=\\$!; sleep 3; kill -TERM \\$p; sleep 0.02; kill -TERM \\$p; wait \\$p\"");
    NEEDS_DISPLAY_OF(result);
    CHECK(result.code == 128 + SIGTERM);
    CHECK(fs::is_empty(folder.path));
}

TEST_CASE("a signal while a model is read ends with the signal's code") {
    const ScratchFolder folder;
    const std::string file = folder / "long.bvh";
    constexpr int frames = 8'000'000;  // seconds of reading
    std::string motion;
    for (int frame = 0; frame < 1000; ++frame)
        motion += "0 0 0 0 0 0\n";
    std::ofstream out(file);
    out << "HIERARCHY\nROOT hips\n{\nOFFSET 0 0 0\nCHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation "
           "Yrotation\nEnd Site\n{\nOFFSET 0 1 0\n}\n}\nMOTION\nFrames: "
        << frames << "\nFrame Time: 0.01\n";
    for (int written = 0; written < frames; written += 1000)
        out << motion;
    out.close();
    const CommandResult result =
        runCommand("timeout --preserve-status --signal=TERM 0.3 '" LUTKA_BINARY "' map '" + file + "'");
    CHECK(result.code == 128 + SIGTERM);
    CHECK(result.err.empty());
}

TEST_CASE("an empty value is wrong usage: a variable of a script that is not set is no run without the option") {
    for (const std::string& line :
         {std::string("map ''"), "build " + kMannequinArgument + " -o ''",
          "simulate " + kMannequinArgument + " --out ''", std::string("simulate --replay ''")}) {
        const CommandResult result = lutkaCommand(line);
        INFO(line);
        CHECK(result.code == 2);
        CHECK(contains(result.err, "empty"));
    }
}

namespace {

const std::string kPlayground = shellQuoted(LUTKA_ASSETS_DIR "/scenes/playground.scene.json");

}  // namespace

TEST_CASE("a scene file brings its own characters: simulated, recorded, replayed and baked doll by doll") {
    const ScratchFolder folder;
    const std::string recording = folder / "run";
    const CommandResult result =
        lutkaCommand("simulate " + kPlayground + " --seconds 0.5 --json --each --out " + (folder / "fall.glb") +
                     " --mesh-out " + (folder / "last.obj") + " --record " + recording);
    INFO(result.err);
    REQUIRE(result.code == 0);
    const Json json = Json::parse(result.out);
    CHECK(json["scene"] == "playground");
    CHECK(json["count"] == 3);
    REQUIRE(json["characters"].size() == 2);
    CHECK(json["characters"][0]["count"].get<int>() + json["characters"][1]["count"].get<int>() == 3);
    for (const char* name : {"fall_0001.glb", "fall_0002.glb", "fall_0003.glb", "last_0001.obj", "last_0003.obj"}) {
        INFO(name);
        CHECK(fs::exists(folder / name));
    }
    CHECK(lutkaCommand("simulate --scene " + kPlayground + " --replay " + recording).code == 0);
    CHECK(lutkaCommand("simulate " + kMannequinArgument + " --replay " + recording).code ==
          2);  // a scene of that name is none
}

TEST_CASE(
    "a scene file and what belongs to named scenes exclude each other, and a model that nobody needs is refused") {
    CHECK(lutkaCommand("simulate").code == 2);
    CHECK(lutkaCommand("simulate " + kPlayground + " --count 2").code == 2);
    CHECK(lutkaCommand("simulate " + kPlayground + " --seed 2").code == 2);
    CHECK(lutkaCommand("simulate " + kPlayground + " --scene " + kPlayground).code == 2);
    const CommandResult both = lutkaCommand("simulate " + kMannequinArgument + " --scene " + kPlayground);
    CHECK(both.code == 2);
    CHECK(contains(both.err, "model of its own"));
    CHECK(lutkaCommand("simulate --scene nowhere.scene.json").code == 3);
}

TEST_CASE("scene writes a named scene as a file that simulates to the same bits, and lists every fault of one") {
    const ScratchFolder folder;
    const std::string file = folder / "stairs.scene.json";
    REQUIRE(lutkaCommand("scene stairs --count 2 --seed 3 --model " + kMannequinArgument + " -o " + file).code == 0);
    const auto hash = [](const std::string& arguments) {
        const CommandResult result = lutkaCommand("simulate --json --seconds 0.5 " + arguments);
        REQUIRE(result.code == 0);
        return Json::parse(result.out)["stateHash"];
    };
    CHECK(hash(file) == hash(kMannequinArgument + " --scene stairs --count 2 --seed 3"));
    CHECK(contains(lutkaCommand("scene " + file).out, "Character 2"));
    std::string text = fileText(file);
    text.replace(text.find("\"steps\": 12"), 11, "\"steps\": 0");
    text.replace(text.find("\"friction\": 0.8"), 15, "\"friction\": \"x\"");
    std::ofstream(file, std::ios::trunc) << text;
    const CommandResult faulty = lutkaCommand("scene " + file);
    CHECK(faulty.code == 3);
    CHECK(contains(faulty.err, "/entities/1/collider/steps"));
    CHECK(contains(faulty.err, "/entities/0/collider/friction"));
    CHECK(contains(faulty.err, "docs/scene.md"));
}

TEST_CASE("bench takes a scene file beside named scenes") {
    const CommandResult result = lutkaCommand("bench --json --steps 10 --count 1 --scene drop," LUTKA_ASSETS_DIR
                                              "/scenes/playground.scene.json");
    REQUIRE(result.code == 0);
    const Json json = Json::parse(result.out);
    REQUIRE(json["cases"].size() == 2);
    CHECK(json["cases"][1]["scene"] == "playground");
    CHECK(json["cases"][1]["count"] == 3);
}
