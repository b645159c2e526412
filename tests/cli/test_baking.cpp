// --out and --mesh-out of simulate: rates, reduced keys, crowds in one file, motion capture, sequences of meshes.
#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "animation/import/figure_file.hpp"
#include "support/catch.hpp"
#include "support/command.hpp"
#include "support/rigs.hpp"

using namespace lutka::test;
using Json = nlohmann::json;
namespace fs = std::filesystem;

namespace {

CommandResult simulate(const std::string& options) {
    return lutkaCommand("simulate " + kMannequinArgument + " --seconds 1 " + options);
}

// How many keys the channel with most of them has.
int mostKeys(const std::string& file) {
    const std::string bytes = fileText(file);
    const auto at = [&](std::size_t i) { return static_cast<std::size_t>(static_cast<unsigned char>(bytes[i])); };
    const Json json = Json::parse(bytes.substr(20, at(12) | at(13) << 8U | at(14) << 16U | at(15) << 24U));
    int most = 0;
    for (const Json& sampler : json["animations"][0]["samplers"])
        most = std::max(most, json["accessors"][sampler["input"].get<std::size_t>()]["count"].get<int>());
    return most;
}

Json inspected(const std::string& file) {
    return Json::parse(lutkaCommand("inspect --json " + file).out);
}

// A figure whose skin has that picture.
GltfFile pictured(const std::string& uri) {
    const lutka::animation::Character figure = makeBiped();
    GltfFile file;
    addFigure(file, figure, "Anna");
    file.json["images"] = {{{"uri", uri}}};
    file.json["textures"] = {{{"source", 0}}};
    file.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    Json& primitive = file.json["meshes"][0]["primitives"][0];
    primitive["material"] = 0;
    const std::vector<float> uvs(2 * figure.meshes[0].positions.size(), 0.5F);
    primitive["attributes"]["TEXCOORD_0"] = file.addFloats(uvs, "VEC2");
    return file;
}

}  // namespace

TEST_CASE("baking: the skin keeps its pictures") {
    const ScratchFolder folder;
    const GltfFile file = pictured(
        "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mP8z8BQ"
        "DwAEhQGAhKmMIQAAAABJRU5ErkJggg==");
    file.saveBinary(folder / "anna.glb");
    REQUIRE(lutkaCommand("simulate " + (folder / "anna.glb") + " --seconds 0.1 --out " + (folder / "fall.glb")).code ==
            0);
    CHECK(inspected(folder / "fall.glb")["textures"].size() == 1);
}

TEST_CASE("baking: a retargeted clip looks for the character's pictures where it has a skin for them") {
    const ScratchFolder folder;
    pictured("nowhere.png").saveBinary(folder / "anna.glb");
    const std::string retarget = "retarget " + kMannequinArgument + " --clip walk --to " + folder / "anna.glb" + " -o ";
    const CommandResult glb = lutkaCommand(retarget + folder / "walk.glb");
    REQUIRE(glb.code == 0);
    CHECK_THAT(glb.err, Catch::Contains("nowhere.png"));
    const CommandResult bvh = lutkaCommand(retarget + folder / "walk.bvh");
    REQUIRE(bvh.code == 0);
    CHECK_THAT(bvh.err, !Catch::Contains("nowhere.png"));
}

TEST_CASE("baking: needless keys are left out unless --no-reduce is given") {
    const ScratchFolder folder;
    REQUIRE(simulate("--out " + folder / "few.glb").code == 0);
    REQUIRE(simulate("--no-reduce --out " + folder / "all.glb").code == 0);
    const auto few = fs::file_size(folder / "few.glb");
    const auto all = fs::file_size(folder / "all.glb");
    CHECK(few < all);
    CHECK(inspected(folder / "few.glb")["clips"][0]["seconds"] == inspected(folder / "all.glb")["clips"][0]["seconds"]);
}

TEST_CASE("baking: --fps sets the rate of clips, and 60 is that of the steps, bit for bit") {
    const ScratchFolder folder;
    REQUIRE(simulate("--no-reduce --fps 24 --out " + folder / "a.glb").code == 0);
    CHECK(mostKeys(folder / "a.glb") == 25);
    REQUIRE(simulate("--no-reduce --fps 60 --out " + folder / "b.glb").code == 0);
    REQUIRE(simulate("--no-reduce --out " + folder / "c.glb").code == 0);
    CHECK(fileText(folder / "b.glb") == fileText(folder / "c.glb"));
    CHECK(simulate("--fps 25 --out " + folder / "d.glb").code == 2);
}

TEST_CASE("baking: render takes --fps for the clip, too, and without it the steps' rate") {
    const ScratchFolder folder;
    const auto render = [&](const std::string& options) {
        return lutkaCommand("render " + kMannequinArgument + " --seconds 0.5 --size 64x64 -o " + (folder / "p.png") +
                            " --no-reduce " + options);
    };
    const CommandResult result = render("--fps 24 --out " + folder / "a.glb");
    NEEDS_DISPLAY_OF(result);
    CHECK(mostKeys(folder / "a.glb") == 13);
    REQUIRE(render("--out " + folder / "b.glb").code == 0);
    CHECK(mostKeys(folder / "b.glb") == 31);
}

TEST_CASE("baking: a retargeted clip leaves needless keys out as well, and is never the larger for it") {
    const ScratchFolder folder;
    const auto sizeOf = [&](const std::string& options) {
        const std::string file = folder / "clip.glb";
        REQUIRE(lutkaCommand("retarget " + kMannequinArgument + " --to " + kMannequinArgument + " -o " + file + options)
                    .code == 0);
        return fs::file_size(file);
    };
    CHECK(sizeOf(" --clip idle") < sizeOf(" --clip idle --no-reduce"));
    // A short clip needs most of its keys, whose times would be further bytes.
    CHECK(sizeOf(" --clip walk") <= sizeOf(" --clip walk --no-reduce"));
}

TEST_CASE("baking: a crowd goes into one file, its skins over one set of meshes") {
    const ScratchFolder folder;
    const std::string file = folder / "crowd.glb";
    REQUIRE(simulate("--count 3 --together --out " + file).code == 0);
    REQUIRE(simulate("--out " + folder / "one.glb").code == 0);
    CHECK(fs::file_size(file) < 2 * fs::file_size(folder / "one.glb"));
    CHECK(inspected(file)["figures"].size() == 3);
    CHECK(simulate("--together --each --out " + file).code == 2);
    CHECK(simulate("--together --out " + folder / "crowd.bvh").code == 2);
}

TEST_CASE("baking: the motion goes out as BVH, and what we read of it lasts as long") {
    const ScratchFolder folder;
    const std::string file = folder / "fall.bvh";
    REQUIRE(simulate("--fps 30 --out " + file).code == 0);
    CHECK(fileText(file).starts_with("HIERARCHY\nROOT "));
    CHECK_THAT(fileText(file), Catch::Contains("Frames: 31\nFrame Time: 0.03333333\n"));
    const Json read = inspected(file);
    CHECK(read["clips"][0]["seconds"].get<double>() == Approx(1.0).margin(1e-3));
    CHECK(Json::parse(lutkaCommand("map --json " + file).out)["humanoid"] == true);
}

TEST_CASE("baking: a sequence of meshes has one a frame, and its last one is that of --mesh-out") {
    const ScratchFolder folder;
    REQUIRE(simulate("--fps 24 --mesh-sequence --mesh-out " + folder / "m.obj").code == 0);
    CHECK(filesIn(folder.path) == 25);
    REQUIRE(simulate("--mesh-out " + folder / "last.obj").code == 0);
    CHECK(fileText(folder / "m_0024.obj") == fileText(folder / "last.obj"));
    CHECK(fileText(folder / "m_0000.obj") != fileText(folder / "m_0024.obj"));
    CHECK(simulate("--mesh-sequence").code == 2);
}
