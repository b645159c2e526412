// glTF as writers spell it beside the specification: what has one meaning only is read, all else is told.

#include <algorithm>
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

std::string spelledText(const GltfFile& file) {
    const TemporaryFolder folder;
    file.saveText(folder / "rig.gltf");
    std::ifstream in(folder / "rig.gltf", std::ios::binary);
    std::stringstream text;
    text << in.rdbuf();
    return text.str();
}

Result<Character> readSpelled(const std::string& text) {
    const TemporaryFolder folder;
    std::ofstream(folder / "rig.gltf", std::ios::binary) << text;
    return importCharacter(folder / "rig.gltf");
}

std::string respelled(std::string text, const std::string& what, const std::string& with) {
    const std::size_t place = text.find(what);
    REQUIRE(place != std::string::npos);
    return text.replace(place, what.size(), with);
}

Character soundPost(const Result<Character>& result) {
    REQUIRE(result.ok());
    checkInvariants(result.value());
    CHECK(result.value().meshes.at(0).positions ==
          readSpelled(spelledText(makePostRig())).value().meshes.at(0).positions);
    return result.value();
}

}  // namespace

TEST_CASE("names of a glTF that are no UTF-8 cost their characters, with a word") {
    const std::string text = spelledText(makePostRig());
    const std::vector<std::string> names{std::string("m\xF6") + "ddle", "m\\ud800ddle", "m\tddle"};
    for (const std::string& name : names) {
        const Character character = soundPost(readSpelled(respelled(text, "\"middle\"", "\"" + name + "\"")));
        CHECK(warns(character, "characters of names"));
        CHECK(findJoint(character.skeleton, "low") != kNoJoint);
    }
    CHECK_FALSE(warns(soundPost(readSpelled(respelled(text, "\"middle\"", "\"m\\ud83d\\ude00ddle\""))), "characters"));
}

TEST_CASE("numbers of a glTF that are none are told, and a null is as if it were not there") {
    const std::string text = spelledText(makePostRig());
    for (const char* number : {"NaN", "-nan(ind)", "Infinity", "-1.#IND", "inf", "1e999", "-1e999"}) {
        INFO(number);
        const Character told = soundPost(
            readSpelled(respelled(text, "\"asset\":{", std::string("\"asset\":{\"extras\":") + number + ",")));
        CHECK(warns(told, "numbers of its JSON that are none"));
    }
    GltfFile nulls = makePostRig();
    for (const char* key : {"extensionsUsed", "animations", "cameras"})
        nulls.json[key] = nullptr;
    for (const char* key : {"children", "mesh", "skin", "rotation"})
        if (!nulls.json["nodes"][3].contains(key)) nulls.json["nodes"][3][key] = nullptr;
    nulls.json["meshes"][0]["primitives"][0]["material"] = nullptr;
    CHECK(soundPost(readSpelled(spelledText(nulls))).warnings.empty());
    GltfFile words = makePostRig();
    words.json["nodes"][0]["translation"] = {"0.1", 0, 0};
    CHECK(warns(soundPost(readSpelled(spelledText(words))), "the translation of nodes"));
}

TEST_CASE("a number of a glTF that is none is told where a measure stands, and refused where an index does") {
    const std::string text = spelledText(makePostRig());
    GltfFile moved = makePostRig();
    moved.json["nodes"][0]["translation"] = {0.125, 0, 0};
    const Character told = soundPost(readSpelled(respelled(spelledText(moved), "0.125", "NaN")));
    CHECK(warns(told, "numbers of its JSON that are none"));
    CHECK(warns(told, "the translation of nodes"));
    const auto refusalOf = [&](const std::string& what, const std::string& with) {
        const std::size_t place = text.find(what);
        REQUIRE(place != std::string::npos);
        const std::size_t value = place + what.size();
        const std::size_t end = text.find_first_of(",]}", value);
        const Result<Character> read = readSpelled(std::string(text).replace(value, end - value, with));
        return read.ok() ? "read" : read.error().message;
    };
    for (const char* key : {"\"indices\":", "\"skin\":", "\"inverseBindMatrices\":", "\"children\":["}) {
        INFO(key);
        CHECK(refusalOf(key, "NaN").find("\"NaN\"") != std::string::npos);
    }
    CHECK(refusalOf("\"inverseBindMatrices\":", "1e999").find("\"1e999\"") != std::string::npos);
    // Words that only begin like one.
    for (const char* word : {"information", "nanny", "NaN0", "1.#index", "infinite"}) {
        INFO(word);
        CHECK(refusalOf("\"scene\":", word).find("broken or cut off") != std::string::npos);
    }
}

TEST_CASE("a glTF in UTF-16 is read, and another text in it refused by that") {
    const std::string text = spelledText(makePostRig());
    for (const bool little : {true, false}) {
        std::string wide = little ? "\xFF\xFE" : "\xFE\xFF";
        for (const char c : text)
            wide += little ? std::string{c, '\0'} : std::string{'\0', c};
        soundPost(readSpelled(wide));
        const TemporaryFolder folder;
        std::ofstream(folder / "rig.bvh", std::ios::binary) << wide;
        const Result<Character> other = importCharacter(folder / "rig.bvh");
        REQUIRE_FALSE(other.ok());
        CHECK(other.error().message == "is a text in UTF-16");
    }
}

TEST_CASE("broken JSON of a glTF is refused with its place, a version to come with its number") {
    const std::string text = spelledText(makePostRig());
    const Result<Character> broken = readSpelled("{\n  \"asset\": {},,\n" + text.substr(1));
    REQUIRE_FALSE(broken.ok());
    CHECK(broken.error().message == "the glTF's JSON is broken or cut off (line 2, character 15)");
    GltfFile later = makePostRig();
    later.json["asset"]["minVersion"] = "2.5";
    const Result<Character> refused = readSpelled(spelledText(later));
    REQUIRE_FALSE(refused.ok());
    CHECK(refused.error().message.find("glTF 2.5") != std::string::npos);
    for (const char* version : {"1.0", "2", "2.0"}) {
        later.json["asset"]["minVersion"] = version;
        soundPost(readSpelled(spelledText(later)));
    }
}

TEST_CASE("nodes that a glTF's scene lists twice or below others stand there once") {
    GltfFile file = makePostRig();
    auto& roots = file.json["scenes"][0]["nodes"];
    const auto first = roots[0];
    roots.push_back(first);
    roots.push_back(file.json["nodes"][first.get<std::size_t>()]["children"][0]);
    CHECK(warns(soundPost(readSpelled(spelledText(file))), "once"));
    GltfFile twice = makePostRig();
    auto& children = twice.json["nodes"][first.get<std::size_t>()]["children"];
    children.push_back(children[0]);
    soundPost(readSpelled(spelledText(twice)));
}

TEST_CASE("a strip or fan may end at the largest number of its index") {
    GltfFile file = makePostRig();
    std::vector<std::uint16_t> strips;
    const Post post = makePost();
    for (std::size_t i = 0; i < post.indices.size(); i += 3) {
        if (i > 0) strips.push_back(0xFFFF);
        strips.insert(strips.end(), post.indices.begin() + static_cast<std::ptrdiff_t>(i),
                      post.indices.begin() + static_cast<std::ptrdiff_t>(i + 3));
    }
    auto& primitive = file.json["meshes"][0]["primitives"][0];
    primitive["indices"] = file.addIndices(strips);
    for (const int mode : {5, 6}) {
        primitive["mode"] = mode;
        const Character character = soundPost(readSpelled(spelledText(file)));
        CHECK(character.meshes[0].indices.size() == post.indices.size());
    }
    primitive["mode"] = 4;
    CHECK_FALSE(readSpelled(spelledText(file)).ok());
    // The largest of a byte is none of a short.
    std::replace(strips.begin(), strips.end(), std::uint16_t{0xFFFF}, std::uint16_t{0xFF});
    primitive["indices"] = file.addIndices(strips);
    primitive["mode"] = 5;
    CHECK_FALSE(readSpelled(spelledText(file)).ok());
}

TEST_CASE("a skin without joints binds nothing, and a mesh keeps the weights that another skin has joints for") {
    GltfFile none = makePostRig();
    none.json["skins"].push_back({{"joints", nlohmann::json::array()}});
    none.json["nodes"].push_back({{"name", "Copy"}, {"mesh", 0}, {"skin", 1}});
    none.json["scenes"][0]["nodes"].push_back(none.json["nodes"].size() - 1);
    CHECK(warns(soundPost(readSpelled(spelledText(none))), "skins without joints"));

    GltfFile shared = makePostRig();  // a second skin of the first joint alone, listed before the whole one
    const auto first = shared.json["skins"][0]["joints"][0];
    const std::size_t matrices = shared.json["skins"][0]["inverseBindMatrices"];
    shared.json["skins"].push_back({{"joints", {first}}, {"inverseBindMatrices", matrices}});
    const std::size_t index = shared.json["nodes"].size();
    shared.json["nodes"].push_back({{"name", "Copy"}, {"mesh", 0}, {"skin", 1}});
    auto& roots = shared.json["scenes"][0]["nodes"];
    roots.insert(roots.begin(), index);
    const Result<Character> read = readSpelled(spelledText(shared));
    REQUIRE(read.ok());
    const Character& character = read.value();
    CHECK(warns(character, "for joints that its skin does not have"));
    const int high = findJoint(character.skeleton, "high");
    REQUIRE(high != kNoJoint);
    CHECK(character.skeleton.skinWeight[static_cast<std::size_t>(high)] > 1.0F);
}

TEST_CASE("a rigid mesh that its node shrinks to nothing is not seen, unless a clip has a scale there") {
    GltfFile file = makePostRig();
    const Post post = makePost();
    const int sword = addPostMesh(file, post, mat4(1.0F), false);
    const int node = file.addNode("Sword", 0, mat4(0.0F));
    file.json["nodes"][static_cast<std::size_t>(node)] = {
        {"name", "Sword"}, {"mesh", sword}, {"scale", {0, 0, 0}}, {"translation", {1, 0, 0}}};
    const Character hidden = soundPost(readSpelled(spelledText(file)));
    CHECK(hidden.meshes.size() == 1);
    CHECK(warns(hidden, "hidden in the file and was left out: Sword"));
    const std::vector<float> times{0, 1};
    const std::vector<float> sizes{0, 0, 0, 1, 1, 1};
    const int input = file.addFloats(times, "SCALAR");
    const int output = file.addFloats(sizes, "VEC3");
    file.json["animations"] = {{{"name", "draw"},
                                {"samplers", {{{"input", input}, {"output", output}}}},
                                {"channels", {{{"sampler", 0}, {"target", {{"node", node}, {"path", "scale"}}}}}}}};
    const Result<Character> drawn = readSpelled(spelledText(file));
    REQUIRE(drawn.ok());
    CHECK_FALSE(warns(drawn.value(), "hidden in the file"));
}

TEST_CASE("a rigid figure whose root has a tiny scale is seen, for units are not known there") {
    GltfFile file;
    const int mesh = addPostMesh(file, makePost(), mat4(1.0F), false);
    const int node = file.addNode("Post", -1, mat4(1.0F));
    file.json["nodes"][static_cast<std::size_t>(node)] = {
        {"name", "Post"}, {"mesh", mesh}, {"scale", {1e-7, 1e-7, 1e-7}}};
    const int sword = file.addNode("Sword", node, mat4(1.0F));
    file.json["nodes"][static_cast<std::size_t>(sword)] = {{"name", "Sword"}, {"mesh", mesh}, {"scale", {0, 0, 0}}};
    const Result<Character> read = readSpelled(spelledText(file));
    REQUIRE(read.ok());
    CHECK(read.value().meshes.size() == 1);
    CHECK(warns(read.value(), "1 mesh is hidden in the file and was left out: Sword"));
}
