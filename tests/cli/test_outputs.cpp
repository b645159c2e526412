#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <nlohmann/json.hpp>

#include "support/catch.hpp"
#include "support/command.hpp"
#include "support/skip.hpp"

using namespace lutka::test;
using Json = nlohmann::json;
namespace fs = std::filesystem;

namespace {

const std::string kLutka = "'" LUTKA_BINARY "' ";

// Every command that prints, with what it prints short enough to stay in a buffer until the end.
const std::vector<std::string> kPrinting = {"--help",
                                            "--version",
                                            "--licenses",
                                            "inspect --help",
                                            "inspect " + kMannequinArgument,
                                            "inspect --json " + kMannequinArgument,
                                            "map " + kMannequinArgument,
                                            "build " + kMannequinArgument,
                                            "build --json " + kMannequinArgument,
                                            "check " + kMannequinArgument,
                                            "scene stairs",
                                            "scene stairs --json",
                                            "simulate --seconds 0.1 " + kMannequinArgument,
                                            "simulate --seconds 0.1 --json " + kMannequinArgument};

CommandResult shell(const std::string& script) {
    return runCommand("sh -c \"" + script + "\"");
}

}  // namespace

TEST_CASE("a full disk under stdout ends every command with 5 and a word") {
    if (!fs::exists("/dev/full")) SKIP_TEST("no /dev/full");
    for (const std::string& command : kPrinting) {
        INFO(command);
        const CommandResult result = shell(kLutka + command + " >/dev/full");
        CHECK(result.code == 5);
        CHECK_THAT(result.err, Catch::Contains("standard output"));
    }
}

TEST_CASE("a closed stdout or a reader that has gone ends every command with 5") {
    for (const std::string& command : kPrinting) {
        INFO(command);
        CHECK(shell(kLutka + command + " >&-").code == 5);
        // The reader is gone before anything is printed.
        CHECK(shell("(sleep 0.2; " + kLutka + command + "; echo \\$? >&2) | true").err.find("5\n") !=
              std::string::npos);
    }
}

TEST_CASE("with stdout closed, nothing that is printed lands in a file that is written") {
    const ScratchFolder folder;
    const std::string profile = folder / "p.ragdoll.json";
    shell(kLutka + "build " + kMannequinArgument + " -o " + profile + " >&-");
    CHECK(Json::parse(fileText(profile))["format"] == "lutka-ragdoll");
}

TEST_CASE("a dash as output is stdout, with the document alone on it") {
    const Json profile = Json::parse(lutkaCommand("build -o - " + kMannequinArgument).out);
    CHECK(profile["format"] == "lutka-ragdoll");
    CHECK(Json::parse(lutkaCommand("map -o - " + kMannequinArgument).out)["humanoid"] == true);
    CHECK(Json::parse(lutkaCommand("scene stairs -o -").out)["format"] == "lutka.scene");
    CHECK_FALSE(fs::exists("-"));
    CHECK(shell(kLutka + "build -o - " + kMannequinArgument + " >/dev/full").code == 5);
}

TEST_CASE("a film that the disk has no room for ends with 5, keeps the old one and leaves nothing") {
    const ScratchFolder folder;
    const std::string film = folder / "fall.mp4";
    std::ofstream(film) << "an old film";
    // A limit on the size of files stands for a disk's: writing fails halfway, with another number.
    const CommandResult result = shell("trap '' XFSZ; ulimit -f 16; " + kLutka + "render " + kMannequinArgument +
                                       " --seconds 1 --size 320x240 -o " + film);
    NEEDS_DISPLAY_OF(result);
    CHECK(result.code == 5);
    CHECK_THAT(result.err, Catch::Contains("fall.mp4"));
    CHECK(fileText(film) == "an old film");
    CHECK(filesIn(folder.path) == 1);
}

TEST_CASE("a limit on the size of files is told like a full disk, and leaves nothing") {
    const ScratchFolder folder;
    const std::string limited = "ulimit -f 1; cd '" + folder.path.string() + "'; ";
    const std::vector<std::pair<std::string, std::string>> outputs = {
        {"build -o big.ragdoll.json", "big.ragdoll.json"},
        {"simulate --seconds 0.5 --out big.glb", "big.glb"},
        {"simulate --seconds 1 --record big.rec", "big.rec"},
        {"report -o big.html", "big.html"},
        {"inspect --json", "standard output"},
    };
    for (const auto& [command, told] : outputs) {
        INFO(command);
        // The program's own prints go to files as well, but for stdout's they stay below the limit.
        const std::string printed = told == "standard output" ? " >printed" : "";
        const CommandResult result = shell(limited + kLutka + command + " " + kMannequinArgument + printed);
        CHECK(result.code == 5);
        CHECK_THAT(result.err, Catch::Contains(told));
        fs::remove(folder.path / "printed");
        CHECK(filesIn(folder.path) == 0);
    }
}

TEST_CASE("a film needs no folder for temporary files") {
    NEEDS_PROGRAM("ffmpeg");
    const ScratchFolder folder;
    const std::string film = folder / "fall.mp4";
    const CommandResult result =
        runCommand("TMPDIR=/nonexistent " + kLutka + "render --seconds 0.2 -o " + film + " " + kMannequinArgument);
    NEEDS_DISPLAY_OF(result);
    CHECK(result.code == 0);
    CHECK(fs::file_size(film) > 0);
}

TEST_CASE("an encoder that says it succeeded and left half a film is not believed") {
    const ScratchFolder folder;
    std::ofstream(folder / "ffmpeg") << "#!/bin/sh\nfor last; do :; done\ncat >/dev/null\n"
                                        "printf '\\0\\0\\0\\20ftypisom\\0\\0\\0\\0' >\"${last#file:}\"\n";
    fs::permissions(folder / "ffmpeg", fs::perms::owner_all);
    fs::create_directory(folder / "out");
    const CommandResult result =
        runCommand("env PATH=" + folder.path.string() + ":$PATH " + kLutka + "render " + kMannequinArgument +
                   " --seconds 0.1 --size 64x64 -o " + (folder / "out/a.mp4"));
    NEEDS_DISPLAY_OF(result);
    CHECK(result.code == 5);
    CHECK_THAT(result.err, Catch::Contains("the film has no end"));
    CHECK(filesIn(folder.path / "out") == 0);
}

TEST_CASE("names that are not UTF-8 work from the model to the report") {
    const ScratchFolder folder;
    const std::string model = folder / "caf\xe9.glb";
    fs::copy_file(LUTKA_ASSETS_DIR "/models/mannequin.glb", model);
    const std::string report = folder / "r\xe9port.json";
    const CommandResult result = lutkaCommand("simulate --seconds 0.1 --json " + shellQuoted(model) + " --report " +
                                              shellQuoted(report) + " --record " + shellQuoted(folder / "rec\xff"));
    REQUIRE(result.code == 0);
    CHECK(Json::parse(result.out)["steps"] == 6);
    CHECK(Json::parse(fileText(report))["steps"] == 6);
    const CommandResult replayed =
        lutkaCommand("simulate " + shellQuoted(model) + " --replay " + shellQuoted(folder / "rec\xff"));
    CHECK(replayed.code == 0);
}

TEST_CASE("one signal ends a command within a second, whatever it is doing") {
    const ScratchFolder folder;
    const std::string report = folder / "r.json";
    // Dolls that walk on: one that lies asleep is stepped through its 3000 s before the signal comes.
    const std::string simulate =
        "simulate " + kMannequinArgument + " --scene march --count 300 --seconds 3600 --report " + report;
    for (const std::string& command : {simulate, std::string("bench --count 500 --steps 100000"),
                                       std::string("edit --headless --frames 10000000")}) {
        INFO(command);
        const CommandResult result = shell(kLutka + command +
                                           " & child=\\$!; sleep 1; kill -TERM \\$child; "
                                           "(sleep 5; kill -KILL \\$child 2>/dev/null) & wait \\$child; echo \\$?");
        if (result.out == "6\n") continue;  // no GL context
        CHECK_THAT(result.out, Catch::Contains("143"));
    }
    CHECK(filesIn(folder.path) == 0);
}

TEST_CASE("where the system allows no more threads, fewer are taken") {
    const std::string simulate = "simulate --seconds 0.1 --count 20 --threads 200 --json " + kMannequinArgument;
    const CommandResult starved = shell("ulimit -v 900000; " + kLutka + simulate);
    REQUIRE(starved.code == 0);
    CHECK(Json::parse(starved.out)["stateHash"] == Json::parse(lutkaCommand(simulate).out)["stateHash"]);
}

TEST_CASE("the program names what it is made of, with versions, and so does its SPDX document") {
    const CommandResult result = lutkaCommand("--licenses");
    REQUIRE(result.code == 0);
    CHECK_THAT(result.out, !Catch::Contains("unknown"));
    const Json document = Json::parse(fileText(fs::path(LUTKA_BINARY).parent_path() / "lutka.spdx.json"));
    CHECK(document["spdxVersion"] == "SPDX-2.3");
    REQUIRE(document["packages"].size() > 10);
    CHECK(document["relationships"].size() == document["packages"].size());
    for (const Json& package : document["packages"]) {
        const auto name = package["name"].get<std::string>();
        CHECK_THAT(result.out, Catch::Contains(name + " " + package["versionInfo"].get<std::string>()));
        CHECK_FALSE(package["licenseDeclared"].get<std::string>().empty());
    }
}

TEST_CASE("a path can't colour the terminal that an error is told on, nor flood it") {
    const CommandResult result = runCommand(kLutka + "inspect '\x1b[31mno\nwhere.glb'");
    CHECK(result.code == 3);
    CHECK(result.err.find('\x1b') == std::string::npos);
    CHECK_THAT(result.err, Catch::Contains(" [31mno where.glb: there is no such file"));
    const ScratchFolder folder;
    std::ofstream(folder / "long.gltf") << Json{
        {"asset", {{"version", "2.0"}}},
        {"buffers", {{{"uri", std::string(100000, 'a')}, {"byteLength", 4}}}},
        {"bufferViews", {{{"buffer", 0}, {"byteLength", 4}}}},
        {"accessors", {{{"bufferView", 0}, {"componentType", 5126}, {"count", 1}, {"type", "VEC3"}}}},
        {"meshes", {{{"primitives", {{{"attributes", {{"POSITION", 0}}}}}}}}},
        {"nodes", {{{"mesh", 0}}}},
        {"scenes", {{{"nodes", {0}}}}},
        {"scene", 0}}.dump();
    const CommandResult flood = lutkaCommand("inspect '" + (folder / "long.gltf") + "'");
    CHECK(flood.code == 3);
    CHECK(flood.err.size() < 5000);
    CHECK_THAT(flood.err, Catch::Contains("more bytes"));
}

TEST_CASE("names that are no UTF-8 are written, and told in what is") {
    const ScratchFolder folder;
    const std::string name = folder / "\xFF\x9B.json";
    const CommandResult result =
        lutkaCommand("simulate --seconds 0.1 " + kMannequinArgument + " --report '" + name + "'");
    CHECK(result.code == 0);
    CHECK(fs::exists(name));
    CHECK_THAT(result.out + result.err, !Catch::Contains("\xFF") && !Catch::Contains("\x9B"));
}

TEST_CASE("the editor's events go to stdout where that is asked for, and count there") {
    const ScratchFolder folder;
    const std::string edit = "edit --headless --frames 2 --size 160x120 --record-input ";
    const CommandResult result = lutkaCommand(edit + "-");
    NEEDS_DISPLAY_OF(result);
    CHECK(result.code == 0);
    CHECK(Json::parse(result.out)["format"] == "lutka.input");
    CHECK_FALSE(fs::exists("-"));
    if (!fs::exists("/dev/full")) SKIP_TEST("this system has no /dev/full");
    CHECK(shell(kLutka + edit + "- > /dev/full; echo \\$?").out == "5\n");
}

TEST_CASE("arguments that are refused can't colour the terminal, nor flood it") {
    for (const char* wrong : {"map a.glb '\x1b[31mb\n.glb'", "'\x1b[31mdance'", "simulate a.glb --count '\x1b[31m1'",
                              "simulate a.glb --gravity '\x1b[31m1'", "map a.glb '--\x1b[31mno'",
                              "simulate a.glb --threads \x1b[31m", "map a.glb --rig '\xC2\x9B'31m"}) {
        INFO(wrong);
        const CommandResult result = runCommand(kLutka + wrong);
        CHECK(result.code == 2);
        CHECK_FALSE(result.err.empty());
        CHECK(std::all_of(result.err.begin(), result.err.end(),
                          [](char c) { return c == '\n' || (static_cast<unsigned char>(c) >= 0x20U && c != '\x7F'); }));
        CHECK_THAT(result.err, !Catch::Contains("\xC2\x9B"));
    }
    const CommandResult flood = runCommand(kLutka + "map a.glb " + std::string(100000, 'b'));
    CHECK(flood.code == 2);
    CHECK(flood.err.size() < 5000);
}

TEST_CASE(
    "no command writes over its model, whatever way leads to it, but a profile goes over the one it was made from") {
    const ScratchFolder folder;
    const fs::path model = folder.path / "hero.glb";
    fs::copy_file(LUTKA_ASSETS_DIR "/models/mannequin.glb", model);
    fs::create_symlink(model, folder.path / "link.glb");
    const std::string was = fileText(model);
    const std::string hero = shellQuoted(model.string());
    const std::string other = shellQuoted((folder.path / "." / "link.glb").string());
    for (const std::string& command :
         {"build " + hero + " -o " + other, "map " + hero + " -o " + other, "map --rig any " + hero + " -o " + other,
          "check " + hero + " --fix " + other, "export " + hero + " -o " + other,
          "retarget " + hero + " --clip walk --to " + kMannequinArgument + " -o " + other,
          "retarget " + kMannequinArgument + " --clip walk --to " + hero + " -o " + other,
          "bench --count 1 --steps 10 " + hero + " --csv " + other,
          "simulate --seconds 0.1 " + hero + " --out " + other}) {
        INFO(command);
        const CommandResult result = lutkaCommand(command);
        CHECK(result.code == 2);
        CHECK_THAT(result.err, Catch::Contains("an output would destroy it"));
        CHECK(fileText(model) == was);
    }
    const std::string profile = folder / "hero.ragdoll.json";
    CHECK(lutkaCommand("build " + hero + " -o " + profile).code == 0);
    CHECK(lutkaCommand("build " + hero + " --profile " + profile + " -o " + profile).code == 0);
}

TEST_CASE("no command writes over its profile, its scene file, its events or its sky") {
    const ScratchFolder folder;
    const std::string profile = folder / "p.ragdoll.json";
    const std::string scene = folder / "s.scene.json";
    const std::string events = folder / "e.jsonl";
    const std::string sky = folder / "sky.hdr";
    REQUIRE(lutkaCommand("build " + kMannequinArgument + " -o " + profile).code == 0);
    REQUIRE(lutkaCommand("scene drop -o " + scene).code == 0);
    std::ofstream(events) << R"({"format": "lutka.input", "version": 1, "size": [160, 120]})" << '\n';
    std::ofstream(sky) << "light";
    const std::string bench = "bench --count 1 --steps 10 " + kMannequinArgument;
    const std::string edit = "edit --headless --frames 1 " + kMannequinArgument;
    const std::string render = "render --seconds 0.1 --size 64x64 " + kMannequinArgument;
    const std::vector<std::pair<std::string, std::string>> commands = {
        {bench + " --profile " + profile + " --csv " + profile, profile},
        {bench + " --scene spread," + scene + " --csv " + scene, scene},
        {edit + " --profile " + profile + " --record-input " + profile, profile},
        {"edit --headless --frames 1 " + scene + " --record-input " + scene, scene},
        {edit + " --input " + events + " --record-input " + events, events},
        {edit + " --input " + events + " --screenshot-at 0:" + events, events},
        {render + " -o " + folder / "a.png" + " --sky " + sky + " --report " + sky, sky},
        {render + " -o " + folder / "a.png" + " --sky " + sky + " --record " + sky, sky}};
    for (const auto& [command, input] : commands) {
        INFO(command);
        const std::string was = fileText(input);
        const CommandResult result = lutkaCommand(command);
        CHECK(result.code == 2);
        CHECK_THAT(result.err, Catch::Contains("an output would destroy it"));
        CHECK(fileText(input) == was);
    }
}

TEST_CASE("a scene file may be written over the one that was read, as it was") {
    const ScratchFolder folder;
    const std::string scene = folder / "s.scene.json";
    REQUIRE(lutkaCommand("scene stairs -o " + scene).code == 0);
    const std::string was = fileText(scene);
    CHECK(lutkaCommand("scene " + scene + " -o " + scene).code == 0);
    CHECK(fileText(scene) == was);
}

TEST_CASE("a clip that is retargeted is glTF or BVH by the ending, in any case, and nothing under another") {
    const ScratchFolder folder;
    const auto retarget = [&](const std::string& name) {
        const std::string command = "retarget " + kMannequinArgument + " --clip walk --to " + kMannequinArgument;
        return lutkaCommand(command + " -o " + folder / name).code;
    };
    CHECK(retarget("walk.GLB") == 0);
    CHECK_THAT(fileText(folder.path / "walk.GLB"), Catch::StartsWith("glTF"));
    CHECK(retarget("walk.bvh") == 0);
    CHECK_THAT(fileText(folder.path / "walk.bvh"), Catch::StartsWith("HIERARCHY"));
    CHECK(retarget("walk.fbx") == 2);
    CHECK(retarget("walk") == 2);
    CHECK_FALSE(fs::exists(folder.path / "walk.fbx"));
    CHECK(lutkaCommand("simulate --seconds 0.1 " + kMannequinArgument + " --out " + folder / "a.BVH").code == 0);
    CHECK_THAT(fileText(folder.path / "a.BVH"), Catch::StartsWith("HIERARCHY"));
    CHECK(lutkaCommand("simulate --seconds 0.1 " + kMannequinArgument + " --mesh-out " + folder / "a.OBJ").code == 0);
    CHECK(lutkaCommand("simulate --seconds 0.1 " + kMannequinArgument + " --mesh-out " + folder / "a.ply").code == 2);
}

TEST_CASE("pipes and devices need no ending, but where a name is that of many files") {
    const ScratchFolder folder;
    const std::string retarget = "retarget " + kMannequinArgument + " --clip walk --to " + kMannequinArgument;
    const CommandResult nowhere = lutkaCommand(retarget + " --json -o /dev/null");
    CHECK(nowhere.code == 0);
    CHECK(Json::parse(nowhere.out)["clip"] == "walk");
    const std::string pipe = folder / "pipe";
    REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
    // A reader that is left alone does not wait for ever.
    const std::string read = "timeout 60 head -c 4 " + pipe + " > " + folder / "read";
    const CommandResult piped =
        shell(read + " & " + kLutka + "simulate --seconds 0.1 " + kMannequinArgument + " --out " + pipe + "; wait");
    CHECK_THAT(piped.err, !Catch::Contains("doesn't end in"));
    CHECK(fileText(folder / "read") == "glTF");
    const std::string simulate = "simulate --seconds 0.1 --count 2 " + kMannequinArgument;
    CHECK(lutkaCommand(simulate + " --out /dev/null --each").code == 2);
    CHECK(lutkaCommand(simulate + " --mesh-out /dev/null --mesh-sequence").code == 2);
    CHECK(lutkaCommand(simulate + " --mesh-out /dev/null").code == 0);
}
