// What Assimp's reader of Collada knows in one spelling alone.

#include <algorithm>
#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <sstream>
#include <string>

#include "animation/import/assimp/collada_text.hpp"
#include "animation/import/checks.hpp"
#include "animation/import/gltf_file.hpp"
#include "support/catch.hpp"

using namespace lutka;
using namespace lutka::animation;
using namespace lutka::test;

namespace {

// The matrix, by rows, that a <skew> of these numbers becomes.
std::vector<double> matrixOf(const std::string& numbers) {
    const std::string text = rig_import::tidyCollada("<node><skew sid=\"s\">" + numbers + "</skew></node>");
    const std::string start = "<node><matrix sid=\"s\">";
    REQUIRE(text.starts_with(start));
    std::istringstream in(text.substr(start.size(), text.find("</matrix></node>") - start.size()));
    std::vector<double> out;
    for (double number = 0.0; in >> number;)
        out.push_back(number);
    REQUIRE(out.size() == 16);
    return out;
}

}  // namespace

TEST_CASE("a Collada skew is a matrix that turns its first axis towards the second by the angle") {
    struct Case {
        double degrees;
        glm::dvec3 turned;
        glm::dvec3 along;
    };
    for (const Case& one : {Case{45, {0, 1, 0}, {1, 0, 0}}, Case{-30, {1, 0, 0}, {0, 0, 2}},
                            Case{20, {0, 2, 1}, {1, 0, 0}}, Case{15, {1, 1, 0}, {1, 0, 0}}}) {
        std::ostringstream numbers;
        numbers << one.degrees << ' ' << one.turned.x << ' ' << one.turned.y << "\n " << one.turned.z << ' '
                << one.along.x << ' ' << one.along.y << ' ' << one.along.z;
        INFO(numbers.str());
        const std::vector<double> m = matrixOf(numbers.str());
        const auto moved = [&](const glm::dvec3& p) {
            return glm::dvec3(m[0] * p.x + m[1] * p.y + m[2] * p.z + m[3], m[4] * p.x + m[5] * p.y + m[6] * p.z + m[7],
                              m[8] * p.x + m[9] * p.y + m[10] * p.z + m[11]);
        };
        CHECK(glm::distance(moved(one.along), one.along) < 1e-12);  // points of the second axis stay
        const glm::dvec3 to = glm::normalize(moved(one.turned));
        const glm::dvec3 from = glm::normalize(one.turned);
        CHECK(glm::degrees(std::acos(glm::dot(to, from))) == Approx(std::abs(one.degrees)));
        const double nearer = glm::dot(to, one.along) - glm::dot(from, one.along);
        CHECK((nearer > 0.0) == (one.degrees > 0.0));
        // What it moves goes along the second axis.
        CHECK(glm::length(glm::cross(moved(one.turned) - one.turned, one.along)) < 1e-12);
    }
    for (const char* damaged : {"45 1 0 0", "45 0 1 0 1 0 0 7", "a b c d e f g"}) {
        INFO(damaged);
        CHECK(rig_import::tidyCollada("<skew>" + std::string(damaged) + "</skew>") ==
              "<matrix>" + std::string(damaged) + "</matrix>");
    }
}

TEST_CASE("pictures of Collada 1.5 are found") {
    const TemporaryFolder folder;
    std::ofstream(folder / "skin.ppm", std::ios::binary) << "P6 1 1 255\n" << std::string("\xff\0\0", 3);
    std::ofstream(folder / "new.dae")
        << "<?xml version=\"1.0\"?><COLLADA xmlns=\"http://www.collada.org/2008/03/COLLADASchema\" version=\"1.5.0\">"
           "<asset><unit meter=\"1\"/><up_axis>Y_UP</up_axis></asset>"
           "<library_images><image id=\"i\"><init_from>\n <ref>skin.ppm</ref>\n </init_from></image></library_images>"
           "<library_effects><effect id=\"fx\"><profile_COMMON><newparam sid=\"p\"><sampler2D>"
           "<instance_image url=\"#i\"/></sampler2D></newparam><technique sid=\"t\"><lambert><diffuse>"
           "<texture texture=\"p\" texcoord=\"UV\"/></diffuse></lambert></technique></profile_COMMON></effect>"
           "</library_effects><library_materials><material id=\"m\"><instance_effect url=\"#fx\"/></material>"
           "</library_materials><library_geometries><geometry id=\"g\"><mesh><source id=\"p3\"><float_array id=\"pa\" "
           "count=\"9\">0 0 0 1 0 0 0 1.8 0</float_array><technique_common><accessor source=\"#pa\" count=\"3\" "
           "stride=\"3\"><param name=\"X\" type=\"float\"/><param name=\"Y\" type=\"float\"/><param name=\"Z\" "
           "type=\"float\"/></accessor></technique_common></source><source id=\"t2\"><float_array id=\"ta\" "
           "count=\"6\">"
           "0 0 1 0 0 1</float_array><technique_common><accessor source=\"#ta\" count=\"3\" stride=\"2\"><param "
           "name=\"S\" type=\"float\"/><param name=\"T\" type=\"float\"/></accessor></technique_common></source>"
           "<vertices id=\"v\"><input semantic=\"POSITION\" source=\"#p3\"/></vertices><triangles count=\"1\" "
           "material=\"m\"><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><input semantic=\"TEXCOORD\" "
           "source=\"#t2\" offset=\"0\"/><p>0 1 2</p></triangles></mesh></geometry></library_geometries>"
           "<library_visual_scenes><visual_scene id=\"s\"><node id=\"n\"><instance_geometry url=\"#g\"><bind_material>"
           "<technique_common><instance_material symbol=\"m\" target=\"#m\"/></technique_common></bind_material>"
           "</instance_geometry></node></visual_scene></library_visual_scenes><scene><instance_visual_scene "
           "url=\"#s\"/></scene></COLLADA>";
    const Character character = imported(folder / "new.dae");
    REQUIRE(character.textures.size() == 1);
    CHECK(character.textures[0].name == "skin.ppm");
    REQUIRE(character.meshes.size() == 1);
    CHECK(character.materials[static_cast<std::size_t>(character.meshes[0].material)].baseColorTexture == 0);
}

TEST_CASE("Collada weights on the bind shape itself are left out, and all others stay whole") {
    const auto tidied = [](const std::string& inputs, const std::string& pairs) {
        return rig_import::tidyCollada("<COLLADA><skin><vertex_weights count=\"3\">" + inputs +
                                       "<vcount>2 1\n2</vcount><v>" + pairs + "</v></vertex_weights></skin></COLLADA>");
    };
    const std::string usual = "<input semantic=\"JOINT\" offset=\"0\"/><input semantic=\"WEIGHT\" offset=\"1\"/>";
    const std::string turned = "<input semantic=\"WEIGHT\" offset=\"0\"/><input semantic=\"JOINT\" offset=\"1\"/>";
    const std::string wanted = "<vcount>1 0 2</vcount><v>4 1 3 4 2 5</v>";
    CHECK(tidied(usual, "-1 0 4 1 -1 3 3 4\t2 5").find(wanted) != std::string::npos);
    CHECK(tidied(turned, "0 -1 1 4 3 -1 4 3 5 2").find(wanted) != std::string::npos);
    CHECK(tidied(usual, "0 0 4 1 1 3 3 4 2 5").find("<v>0 0 4 1 1 3 3 4 2 5</v>") != std::string::npos);
}
