// Every property of a glTF material, from a generated file to the colour of pixels: squares side by side, each with a
// material of its own, lit from the front or from the right.

#include <cmath>
#include <filesystem>

#include "animation/import/gltf_file.hpp"
#include "animation/import/import_character.hpp"
#include "gl_fixture.hpp"
#include "render/gl/pixels.hpp"

using namespace lutka;
using namespace lutka::test;
using namespace lutka::render;

namespace {

constexpr Extent kMaterialsSize{480, 120};
constexpr float kHalf = 0.4F;  // of a square's side, metres; squares stand a metre apart

class Squares {
  public:
    Squares() {
        file_.json["materials"] = nlohmann::json::array();
        file_.json["meshes"] = nlohmann::json::array();
        file_.json["textures"] = nlohmann::json::array();
        file_.json["images"] = nlohmann::json::array();
        root_ = file_.addNode("root", -1);
    }

    /// A picture of two pixels, left and right, as a texture.
    nlohmann::json texture(Color left, Color right) {
        Image image({2, 1}, left);
        image.set(1, 0, right);
        const std::string name = "texture" + std::to_string(file_.json["images"].size()) + ".png";
        REQUIRE(savePng(image, folder_ / name).ok());
        return named(name);
    }
    /// A texture whose picture is whatever file of that name there is.
    nlohmann::json named(const std::string& name) {
        const auto index = file_.json["images"].size();
        file_.json["images"].push_back({{"uri", name}});
        file_.json["textures"].push_back({{"source", index}});
        return {{"index", index}};
    }

    /// With `colors`: those of the corners, from the lower left anticlockwise, RGBA.
    void add(const nlohmann::json& material, bool facingAway = false, const std::vector<float>& colors = {}) {
        const float side = facingAway ? -1.0F : 1.0F;
        const std::vector<float> positions = {-kHalf, -kHalf, 0, kHalf, -kHalf, 0, kHalf, kHalf, 0, -kHalf, kHalf, 0};
        const std::vector<float> normals = {0, 0, side, 0, 0, side, 0, 0, side, 0, 0, side};
        const std::vector<float> uvs = {0, 1, 1, 1, 1, 0, 0, 0};
        const std::vector<std::uint16_t> front = {0, 1, 2, 0, 2, 3};
        const std::vector<std::uint16_t> back = {0, 2, 1, 0, 3, 2};
        const int position = file_.addFloats(positions, "VEC3");
        file_.json["accessors"][position]["min"] = {-kHalf, -kHalf, 0};
        file_.json["accessors"][position]["max"] = {kHalf, kHalf, 0};
        const int normal = file_.addFloats(normals, "VEC3");
        const int uv = file_.addFloats(uvs, "VEC2");
        const int indices = file_.addIndices(facingAway ? back : front);
        const auto number = file_.json["materials"].size();
        file_.json["materials"].push_back(material);
        nlohmann::json attributes = {{"POSITION", position}, {"NORMAL", normal}, {"TEXCOORD_0", uv}};
        if (!colors.empty()) attributes["COLOR_0"] = file_.addFloats(colors, "VEC4");
        file_.json["meshes"].push_back(
            {{"primitives", {{{"attributes", attributes}, {"indices", indices}, {"material", number}}}}});
        mat4 place(1.0F);
        place[3] = vec4(static_cast<float>(number), 0, 0, 1);
        const int node = file_.addNode("square" + std::to_string(number), root_, place);
        file_.json["nodes"][node]["mesh"] = number;
    }

    [[nodiscard]] animation::Character load() {
        const std::filesystem::path path = folder_ / "squares.gltf";
        file_.saveText(path);
        animation::ImportOptions options;
        options.loadTextures = true;
        options.metresPerFileUnit = 1.0F;
        Result<animation::Character> loaded = animation::importCharacter(path, options);
        if (!loaded) FAIL(loaded.error().text());
        return std::move(loaded).value();
    }
    [[nodiscard]] std::size_t count() const { return file_.json["materials"].size(); }

  private:
    TemporaryFolder folder_;
    GltfFile file_;
    int root_ = 0;
};

/// The squares seen from straight ahead.
struct Picture {
    animation::Character character;
    std::vector<animation::SkinMatrix> palette;
    FrameDescription frame;
    Image image;

    Picture(GlFixture& gl, Squares& squares, const vec3& towardsLight = {0, 0, 1})
        : character(squares.load()), palette(bindPalette(character.skeleton)) {
        CharacterItem item;
        item.character = gl.upload(character);
        item.palette = palette;
        frame.characters.push_back(item);
        frame.floor.visible = false;
        frame.ambientOcclusion = false;
        frame.sun.directionToLight = towardsLight;
        frame.sun.castsShadow = false;
        frame.camera.yaw = 0.0F;
        frame.camera.pitch = 0.0F;
        frame.camera.orthographic = true;
        const auto across = static_cast<float>(squares.count());
        frameSphere(frame.camera, {0.5F * (across - 1.0F), 0, 0}, 0.5F * across, 1.0F);
        frame.camera.distance /= kMaterialsSize.aspect();
        frame.camera.distance *= 1.1F;
        image = gl.picture(frame, kMaterialsSize);
    }

    /// The left (-1) or right (1) half of a square.
    [[nodiscard]] Color at(int square, int half) const {
        return pixel(static_cast<float>(square) + 0.5F * kHalf * static_cast<float>(half));
    }
    /// The backdrop at the same height, between two squares.
    [[nodiscard]] Color behind() const { return pixel(0.5F); }

  private:
    [[nodiscard]] Color pixel(float x) const {
        const auto seen = project(frame.camera, {x, 0, 0}, kMaterialsSize);
        REQUIRE(seen.has_value());
        return image.at(static_cast<int>(seen->x), static_cast<int>(seen->y));
    }
};

std::string describe(Color color) {
    return std::to_string(color.r) + " " + std::to_string(color.g) + " " + std::to_string(color.b);
}

bool near(Color a, Color b, int tolerance) {
    return std::abs(a.r - b.r) <= tolerance && std::abs(a.g - b.g) <= tolerance && std::abs(a.b - b.b) <= tolerance;
}

const nlohmann::json kMatte = {{"metallicFactor", 0.0}, {"roughnessFactor", 0.9}};

}  // namespace

TEST_CASE("base colour: factor and texture multiply, the picture's left is the square's left") {
    const auto gl = GlFixture::create();
    NEEDS_GL(gl);
    Squares squares;
    nlohmann::json plain = kMatte;
    plain["baseColorFactor"] = {0.8, 0.1, 0.1, 1.0};
    squares.add({{"pbrMetallicRoughness", plain}});
    nlohmann::json textured = kMatte;
    textured["baseColorTexture"] = squares.texture({40, 220, 40, 255}, {220, 40, 220, 255});
    squares.add({{"pbrMetallicRoughness", textured}});
    textured["baseColorFactor"] = {1.0, 1.0, 0.0, 1.0};
    squares.add({{"pbrMetallicRoughness", textured}});
    const Picture picture(*gl, squares);
    CHECK(picture.at(0, -1).r > picture.at(0, -1).g + 60);
    CHECK(picture.at(1, -1).g > picture.at(1, -1).r + 30);
    CHECK(picture.at(1, 1).b > picture.at(1, 1).g + 30);
    CHECK(picture.at(2, 1).r > picture.at(2, 1).b + 60);  // the factor takes the blue out
}

TEST_CASE("vertex colours multiply the base colour in linear light, and their alpha that of the material") {
    const auto gl = GlFixture::create();
    NEEDS_GL(gl);
    Squares squares;
    const std::vector<float> leftRed = {1, 0, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 1, 0, 0, 1};
    squares.add({{"pbrMetallicRoughness", kMatte}}, false, leftRed);
    nlohmann::json half = kMatte;
    half["baseColorFactor"] = {0.5, 0.5, 0.5, 1.0};
    squares.add({{"pbrMetallicRoughness", half}});
    squares.add({{"pbrMetallicRoughness", kMatte}}, false, std::vector<float>(16, 0.5F));
    nlohmann::json green = kMatte;
    green["baseColorTexture"] = squares.texture({40, 220, 40, 255}, {40, 220, 40, 255});
    const std::vector<float> blackRight = {1, 1, 1, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1, 1};
    squares.add({{"pbrMetallicRoughness", green}}, false, blackRight);
    const std::vector<float> clearLeft = {1, 1, 1, 0, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 0};
    nlohmann::json dark = kMatte;
    dark["baseColorFactor"] = {0.01, 0.01, 0.01, 1.0};
    squares.add({{"pbrMetallicRoughness", dark}, {"alphaMode", "MASK"}, {"alphaCutoff", 0.5}}, false, clearLeft);
    const Picture picture(*gl, squares, {1, 0, 0.8F});
    CHECK(picture.at(0, -1).r > picture.at(0, -1).g + 20);
    CHECK(picture.at(0, 1).g > picture.at(0, 1).r + 20);
    INFO(describe(picture.at(1, 0)) << " and " << describe(picture.at(2, 0)));
    CHECK(near(picture.at(1, 0), picture.at(2, 0), 2));
    CHECK(picture.at(3, -1).g > picture.at(3, -1).r + 30);
    CHECK(brightness(picture.at(3, 1)) < brightness(picture.at(3, -1)) - 60);
    CHECK(brightness(picture.at(4, -1)) > 0.7 * brightness(picture.behind()));
    CHECK(brightness(picture.at(4, 1)) < 0.55 * brightness(picture.behind()));
}

TEST_CASE("metallic and roughness: a metal has no diffuse colour and a rough one spreads the light") {
    const auto gl = GlFixture::create();
    NEEDS_GL(gl);
    Squares squares;
    const auto surface = [](double metallic, double roughness) {
        return nlohmann::json{{"pbrMetallicRoughness",
                               {{"baseColorFactor", {0.9, 0.6, 0.2, 1.0}},
                                {"metallicFactor", metallic},
                                {"roughnessFactor", roughness}}}};
    };
    squares.add(surface(0.0, 0.5));
    squares.add(surface(1.0, 0.05));
    squares.add(surface(1.0, 1.0));
    nlohmann::json textured = surface(1.0, 1.0);
    // Green is the roughness, blue the metal: left a smooth metal, right a rough dielectric.
    textured["pbrMetallicRoughness"]["metallicRoughnessTexture"] = squares.texture({0, 13, 255, 255}, {0, 255, 0, 255});
    squares.add(textured);
    // From the side: a mirror shows the sky, not the sun.
    const Picture picture(*gl, squares, {1, 0, 0.6F});
    CHECK(brightness(picture.at(0, 0)) > brightness(picture.at(1, 0)) + 40);
    CHECK(brightness(picture.at(2, 0)) > brightness(picture.at(1, 0)) + 15);
    INFO(describe(picture.at(3, -1)) << " and " << describe(picture.at(1, 0)));
    CHECK(near(picture.at(3, -1), picture.at(1, 0), 16));
    CHECK(brightness(picture.at(3, 1)) > brightness(picture.at(3, -1)) + 40);
}

TEST_CASE("a normal map tilts the light: the half that leans towards it is brighter") {
    const auto gl = GlFixture::create();
    NEEDS_GL(gl);
    Squares squares;
    nlohmann::json leaning = {{"pbrMetallicRoughness", kMatte}};
    leaning["normalTexture"] = squares.texture({218, 128, 218, 255}, {38, 128, 218, 255});
    squares.add(leaning);
    squares.add({{"pbrMetallicRoughness", kMatte}});
    const Picture picture(*gl, squares, {1, 0, 0.8F});
    CHECK(brightness(picture.at(0, -1)) > brightness(picture.at(1, 0)) + 20);
    CHECK(brightness(picture.at(0, 1)) < brightness(picture.at(1, 0)) - 40);
}

TEST_CASE("an occlusion map darkens the sky's light and an emissive one glows without any") {
    const auto gl = GlFixture::create();
    NEEDS_GL(gl);
    Squares squares;
    nlohmann::json occluded = {{"pbrMetallicRoughness", kMatte}};
    occluded["occlusionTexture"] = squares.texture({30, 30, 30, 255}, {255, 255, 255, 255});
    squares.add(occluded);
    nlohmann::json glowing = {{"pbrMetallicRoughness", kMatte}};
    glowing["pbrMetallicRoughness"]["baseColorFactor"] = {0.02, 0.02, 0.02, 1.0};
    glowing["emissiveFactor"] = {1.0, 1.0, 1.0};
    glowing["emissiveTexture"] = squares.texture({30, 230, 30, 255}, {0, 0, 0, 255});
    squares.add(glowing);
    // The sun stands behind: only the sky lights the fronts.
    const Picture picture(*gl, squares, {0, 0, -1});
    CHECK(brightness(picture.at(0, 1)) > brightness(picture.at(0, -1)) + 100);
    CHECK(picture.at(1, -1).g > picture.at(1, -1).r + 80);
    CHECK(brightness(picture.at(1, 1)) < 150);
}

TEST_CASE("an alpha mask cuts out, blending mixes, and single-sided backs are not there") {
    const auto gl = GlFixture::create();
    NEEDS_GL(gl);
    Squares squares;
    nlohmann::json masked = {{"pbrMetallicRoughness", kMatte}, {"alphaMode", "MASK"}, {"alphaCutoff", 0.5}};
    masked["pbrMetallicRoughness"]["baseColorTexture"] = squares.texture({10, 10, 10, 40}, {10, 10, 10, 255});
    squares.add(masked);
    nlohmann::json glass = {{"pbrMetallicRoughness", kMatte}, {"alphaMode", "BLEND"}};
    glass["pbrMetallicRoughness"]["baseColorFactor"] = {0.0, 0.0, 0.0, 0.5};
    squares.add(glass);
    const nlohmann::json black = {
        {"pbrMetallicRoughness",
         {{"baseColorFactor", {0.01, 0.01, 0.01, 1.0}}, {"metallicFactor", 0.0}, {"roughnessFactor", 0.9}}}};
    squares.add(black, true);
    nlohmann::json twoSided = black;
    twoSided["doubleSided"] = true;
    squares.add(twoSided, true);
    const Picture picture(*gl, squares, {1, 0, 0.4F});  // no highlight towards the eye
    const auto hidden = [&](Color color) { return brightness(color) < 0.55 * brightness(picture.behind()); };
    CHECK_FALSE(hidden(picture.at(0, -1)));
    CHECK(hidden(picture.at(0, 1)));
    const int mixed = brightness(picture.at(1, 0));
    CHECK(mixed < 0.9 * brightness(picture.behind()));
    CHECK(mixed > 0.35 * brightness(picture.behind()));
    CHECK_FALSE(hidden(picture.at(2, 0)));
    CHECK(hidden(picture.at(3, 0)));
}

TEST_CASE("a missing texture leaves a visible neutral material and one warning") {
    const auto gl = GlFixture::create();
    NEEDS_GL(gl);
    Squares squares;
    nlohmann::json lost = kMatte;
    lost["baseColorTexture"] = squares.named("gone.png");
    squares.add({{"name", "cloth"}, {"pbrMetallicRoughness", lost}});
    squares.add({{"name", "hat"}, {"pbrMetallicRoughness", lost}});
    const Picture picture(*gl, squares);
    for (const int square : {0, 1}) {
        const Color color = picture.at(square, 0);
        CHECK(brightness(color) > 240);  // neither black nor not there …
        CHECK(std::abs(color.r - color.b) < 40);
        CHECK(brightness(color) != brightness(picture.behind()));
    }
    const auto mentions = [](const std::string& text) { return text.find("gone.png") != std::string::npos; };
    CHECK(std::count_if(picture.character.warnings.begin(), picture.character.warnings.end(), mentions) == 1);
    CHECK(gl->renderer.warnings().empty());
}
