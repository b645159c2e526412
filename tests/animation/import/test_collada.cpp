// Collada as exporters write it: blanks and line breaks around numbers, other encodings.

#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <string>

#include "animation/import/assimp/collada_bind_shape.hpp"
#include "animation/import/assimp/collada_links.hpp"
#include "animation/import/assimp/collada_text.hpp"
#include "animation/import/checks.hpp"
#include "animation/import/gltf_file.hpp"
#include "support/catch.hpp"

using namespace lutka;
using namespace lutka::animation;
using namespace lutka::test;

namespace {

// A triangle 1.8 units tall with a red material; `pad` stands around every number and reference.
std::string triangle(const std::string& pad) {
    const auto padded = [&](const std::string& text) { return pad + text + pad; };
    return "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n"
           "<COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\">\n"
           "<!-- 1 < 2 > 0, \"as ever -->\n"
           "<asset><unit meter=\"1\" name=\"a > b\"/><up_axis>Y_UP</up_axis></asset>\n"
           "<library_effects><effect id=\"fx\"><profile_COMMON><technique sid=\"t\"><lambert><diffuse><color>" +
           padded("1.0 0.0 0.0 1.0") +
           "</color></diffuse></lambert></technique></profile_COMMON></effect></library_effects>\n"
           "<library_materials><material id=\"m\" name=\"m\"><instance_effect url=\"#fx\"/></material>"
           "</library_materials>\n"
           "<library_geometries><geometry id=\"g\" name=\"g\"><mesh><source id=\"p\"><float_array id=\"pa\" "
           "count=\"9\">" +
           padded("0 0 0" + pad + " 1 0 0 0 1.8 0") +
           "</float_array><technique_common><accessor source=\"#pa\" count=\"3\" stride=\"3\">"
           "<param name=\"X\" type=\"float\"/><param name=\"Y\" type=\"float\"/><param name=\"Z\" type=\"float\"/>"
           "</accessor></technique_common></source><vertices id=\"v\"><input semantic=\"POSITION\" source=\"#p\"/>"
           "</vertices><triangles count=\"1\" material=\"m\"><input semantic=\"VERTEX\" source=\"#v\" "
           "offset=\"0\"/><p>" +
           padded("0 1 2") +
           "</p></triangles></mesh></geometry></library_geometries>\n"
           "<library_visual_scenes><visual_scene id=\"s\"><node id=\"n\" name=\"n\"><matrix>" +
           padded("1 0 0 0.5 0 1 0 0 0 0 1 0 0 0 0 1") +
           "</matrix><instance_geometry url=\"#g\"><bind_material><technique_common>"
           "<instance_material symbol=\"m\" target=\"#m\"/></technique_common></bind_material></instance_geometry>"
           "</node></visual_scene></library_visual_scenes>\n"
           "<scene><instance_visual_scene url=\"#s\"/></scene></COLLADA>\n";
}

std::string utf16Of(const std::string& ascii, bool little) {
    std::string out = little ? "\xFF\xFE" : "\xFE\xFF";
    for (const char c : ascii) {
        if (!little) out += '\0';
        out += c;
        if (little) out += '\0';
    }
    return out;
}

void checkTriangle(const std::filesystem::path& folderFile, const std::string& text) {
    std::ofstream(folderFile, std::ios::binary) << text;
    const Character character = imported(folderFile);
    checkInvariants(character);
    REQUIRE(character.meshes.size() == 1);
    REQUIRE(character.meshes[0].positions.size() == 3);
    float low = 9.0F;
    float high = -9.0F;
    for (const vec3& p : character.meshes[0].positions) {
        low = std::min(low, p.y);
        high = std::max(high, p.y);
    }
    CHECK(high - low == Approx(1.8F));
    const Material& material = character.materials.at(character.meshes[0].material);
    CHECK(material.baseColor.r > 0.9F);
    CHECK(material.baseColor.g < 0.1F);
}

std::string numbersOf(const glm::mat4& matrix) {
    std::string out;
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column)
            out += std::to_string(matrix[column][row]) + " ";
    return out;
}

// A strip 1.8 tall in the armature's space on two joints at 0.2 and 1.0, as Blender writes it: the bind shape matrix
// says how the mesh stands in the armature, which stands at `armature` itself.
std::string skinnedStrip(const glm::mat4& armature, const std::string& tool,
                         const glm::mat4& bindShape = glm::mat4(1.0F)) {
    const auto at = [](float height) { return glm::translate(glm::mat4(1.0F), vec3(0, height, 0)); };
    const std::string xyz =
        "<param name=\"X\" type=\"float\"/><param name=\"Y\" type=\"float\"/><param name=\"Z\" "
        "type=\"float\"/></accessor></technique_common></source>";
    return "<?xml version=\"1.0\"?><COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" "
           "version=\"1.4.1\"><asset><contributor><authoring_tool>" +
           tool +
           "</authoring_tool></contributor><unit meter=\"1\" name=\"meter\"/><up_axis>Y_UP</up_axis></asset>"
           "<library_geometries><geometry id=\"g\"><mesh><source id=\"p\"><float_array id=\"pa\" count=\"18\">"
           "-0.1 0 0 0.1 0 0 -0.1 0.9 0 0.1 0.9 0 -0.1 1.8 0 0.1 1.8 0</float_array><technique_common>"
           "<accessor source=\"#pa\" count=\"6\" stride=\"3\">" +
           xyz +
           "<vertices id=\"v\"><input semantic=\"POSITION\" source=\"#p\"/></vertices><triangles count=\"4\">"
           "<input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><p>0 1 2 1 3 2 2 3 4 3 5 4</p></triangles></mesh>"
           "</geometry></library_geometries><library_controllers><controller id=\"c\"><skin source=\"#g\">"
           "<bind_shape_matrix>" +
           numbersOf(bindShape) +
           "</bind_shape_matrix><source id=\"j\"><Name_array "
           "id=\"ja\" count=\"2\">low high</Name_array><technique_common><accessor source=\"#ja\" count=\"2\">"
           "<param name=\"JOINT\" type=\"name\"/></accessor></technique_common></source><source id=\"b\"><float_array "
           "id=\"ba\" count=\"32\">" +
           numbersOf(glm::inverse(armature * at(0.2F))) + numbersOf(glm::inverse(armature * at(1.0F))) +
           "</float_array><technique_common><accessor source=\"#ba\" count=\"2\" stride=\"16\"><param "
           "name=\"TRANSFORM\" type=\"float4x4\"/></accessor></technique_common></source><source id=\"w\"><float_array "
           "id=\"wa\" count=\"1\">1</float_array><technique_common><accessor source=\"#wa\" count=\"1\" "
           "stride=\"1\"><param name=\"WEIGHT\" type=\"float\"/></accessor></technique_common></source><joints>"
           "<input semantic=\"JOINT\" source=\"#j\"/><input semantic=\"INV_BIND_MATRIX\" source=\"#b\"/></joints>"
           "<vertex_weights count=\"6\"><input semantic=\"JOINT\" source=\"#j\" offset=\"0\"/><input "
           "semantic=\"WEIGHT\" source=\"#w\" offset=\"1\"/><vcount>1 1 1 1 1 1</vcount>"
           "<v>0 0 0 0 0 0 1 0 1 0 1 0</v></vertex_weights></skin></controller></library_controllers>"
           "<library_visual_scenes><visual_scene id=\"s\"><node id=\"rig\" name=\"rig\"><matrix>" +
           numbersOf(armature) + "</matrix><node id=\"low\" sid=\"low\" name=\"low\" type=\"JOINT\"><matrix>" +
           numbersOf(at(0.2F)) + "</matrix><node id=\"high\" sid=\"high\" name=\"high\" type=\"JOINT\"><matrix>" +
           numbersOf(at(0.8F)) +
           "</matrix></node></node><node id=\"body\" name=\"body\"><instance_controller url=\"#c\"><skeleton>#low"
           "</skeleton></instance_controller></node></node></visual_scene></library_visual_scenes><scene>"
           "<instance_visual_scene url=\"#s\"/></scene></COLLADA>";
}

// How far the lowest vertices' middle lies from the lower joint, of the strip's length.
float soleToJoint(const Character& character) {
    const std::vector<vec3>& places = character.meshes.at(0).positions;
    vec3 low = places[0];
    vec3 high = places[0];
    for (const vec3& place : places) {
        low = glm::min(low, place);
        high = glm::max(high, place);
    }
    const vec3 sole = 0.5F * (places[0] + places[1]);
    const int joint = findJoint(character.skeleton, "low");
    return glm::distance(sole, character.skeleton.bindModelFromJoint[joint].translation) / glm::distance(low, high);
}

}  // namespace

TEST_CASE("Collada's numbers may stand between blanks, tabs and line breaks") {
    const TemporaryFolder folder;
    for (const std::string pad : {"", "  ", "\n", "\r\n\t", " \n \n "}) {
        INFO(pad.size());
        checkTriangle(folder / "triangle.dae", triangle(pad));
    }
}

TEST_CASE("Collada in UTF-16 is read as in UTF-8") {
    const TemporaryFolder folder;
    for (const bool little : {true, false}) {
        std::string text = triangle("\n");
        text.replace(text.find("utf-8"), 5, "utf-16");
        checkTriangle(folder / "triangle.dae", utf16Of(text, little));
    }
}

TEST_CASE("a polylist's count is that of its polygons, and colours have four numbers") {
    using rig_import::tidyCollada;
    CHECK(tidyCollada("<polylist material=\"a\" count=\"4\"><input offset=\"0\"/><vcount>4 3</vcount></polylist>") ==
          "<polylist material=\"a\" count=\"2\"><input offset=\"0\"/><vcount>4 3</vcount></polylist>");
    CHECK(tidyCollada("<vertex_weights count=\"3\"><vcount>1 1</vcount>") ==
          "<vertex_weights count=\"3\"><vcount>1 1</vcount>");
    CHECK(tidyCollada("<color> 0.1 0.2  0.3 </color><color>1 1 1 0.5</color>") ==
          "<color>0.1 0.2 0.3 1</color><color>1 1 1 0.5</color>");
    CHECK(tidyCollada("<polylist><vcount>3</vcount>") == "<polylist><vcount>3</vcount>");
}

TEST_CASE("a skin without a bind shape matrix has the identity") {
    using rig_import::tidyCollada;
    const std::string identity = "<bind_shape_matrix>1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</bind_shape_matrix>";
    CHECK(tidyCollada("<skin source=\"#g\"><source id=\"j\">") ==
          "<skin source=\"#g\">" + identity + "<source id=\"j\">");
    CHECK(tidyCollada("<skin><!-- none --><source>") == "<skin><!-- none -->" + identity + "<source>");
    const std::string whole = "<skin><!-- one --><bind_shape_matrix>2 0 0 0</bind_shape_matrix><source>";
    CHECK(tidyCollada(whole) == whole);
}

TEST_CASE("skins that Blender wrote lie on their joints wherever the armature stands") {
    const TemporaryFolder folder;
    const glm::mat4 one(1.0F);
    const glm::mat4 armatures[] = {one, glm::translate(one, vec3(40, 3, -25)), glm::scale(one, vec3(0.01F)),
                                   glm::rotate(one, 1.57F, vec3(1, 0, 0)), glm::scale(one, vec3(1, 1.3F, 1))};
    for (const glm::mat4& armature : armatures) {
        std::ofstream(folder / "strip.dae", std::ios::binary) << skinnedStrip(armature, "Blender 3.4.1");
        const Character character = imported(folder / "strip.dae");
        checkInvariants(character);
        CHECK(soleToJoint(character) == Approx(0.2F / std::hypot(1.8F, 0.2F)).epsilon(0.02));
    }
    // A mesh beside its joints in a small armature: the node that shows it has no matrix.
    const glm::mat4 beside = glm::translate(one, vec3(0.5F, 0, 0));
    std::ofstream(folder / "strip.dae", std::ios::binary) << skinnedStrip(armatures[2], "Blender 4.1.0", beside);
    CHECK(soleToJoint(imported(folder / "strip.dae")) ==
          Approx(std::hypot(0.2F, 0.5F) / std::hypot(1.8F, 0.2F)).epsilon(0.02));
    // With a sign before each number.
    std::string withSigns = skinnedStrip(armatures[2], "Blender 4.1.0", beside);
    const std::size_t first = withSigns.find("<bind_shape_matrix>") + 19;
    for (std::size_t at = first; withSigns[at] != '<'; at = withSigns.find(' ', at) + 1)
        if (withSigns[at] != '-') withSigns.insert(at, "+");
    std::ofstream(folder / "strip.dae", std::ios::binary) << withSigns;
    CHECK(soleToJoint(imported(folder / "strip.dae")) ==
          Approx(std::hypot(0.2F, 0.5F) / std::hypot(1.8F, 0.2F)).epsilon(0.02));
    // Old versions wrote how the mesh stands in the scene.
    std::ofstream(folder / "strip.dae", std::ios::binary) << skinnedStrip(armatures[1], "Blender 2.57", armatures[1]);
    CHECK(soleToJoint(imported(folder / "strip.dae")) < 0.2F);
    // Of others the matrix is what it says: this skin stands where it stands.
    std::ofstream(folder / "strip.dae", std::ios::binary) << skinnedStrip(armatures[1], "FBX COLLADA exporter");
    CHECK(soleToJoint(imported(folder / "strip.dae")) > 10.0F);
}

TEST_CASE("a Collada node without an id has no skin's bind shape matrix, nor a link to nothing one without an id") {
    const std::string matrix = "<bind_shape_matrix>1 0 0 7 0 1 0 0 0 0 1 0 0 0 0 1</bind_shape_matrix>";
    const std::string blender = "<authoring_tool>Blender 4.1.0</authoring_tool>";
    for (const std::string& document :
         {blender + "<controller id=\"c\">" + matrix + "</controller><node><instance_controller url=\"#c\"/></node>",
          blender + "<controller>" + matrix +
              "</controller><node id=\"body\"><instance_controller url=\"\"/></node>"}) {
        // A small armature whose joint stands where the mesh does once it is scaled, and no farther off.
        rig_import::SourceScene scene;
        scene.nodes = {{"scene", -1}, {"rig", 0, glm::scale(glm::dmat4(1.0), glm::dvec3(0.01))}, {"", 1}};
        if (document.find("body") != std::string::npos) scene.nodes[2].name = "body";
        rig_import::SourceMesh mesh;
        mesh.positions = {vec3(0)};
        mesh.influenceStart = {0, 1};
        mesh.influences = {{0, 1.0F}};
        scene.meshes.push_back(mesh);
        rig_import::SourceSkin skin;
        skin.joints.push_back({1});
        scene.skins.push_back(skin);
        scene.instances.push_back({0, 2, 0});
        rig_import::completeBindShapes(rig_import::ColladaDocument(document), scene);
        CHECK(scene.skins[0].joints[0].jointFromMesh == glm::scale(glm::dmat4(1.0), glm::dvec3(0.01)));
    }
}

TEST_CASE("weights stand as pairs of joint and weight, whatever their order was") {
    using rig_import::tidyCollada;
    const auto weights = [](const std::string& inputs, const std::string& numbers) {
        return "<vertex_weights count=\"2\">" + inputs + "<vcount>2 1</vcount><v>" + numbers + "</v></vertex_weights>";
    };
    const std::string joint = "<input semantic=\"JOINT\" source=\"#j\" offset=\"0\"/>";
    const std::string weight = "<input semantic=\"WEIGHT\" source=\"#w\" offset=\"1\"/>";
    const std::string whole = weights(joint + weight, "5 0 6 1 7 2");
    CHECK(tidyCollada(whole) == whole);
    CHECK(tidyCollada(weights("<input semantic=\"WEIGHT\" source=\"#w\" offset=\"0\"/>"
                              "<input semantic=\"JOINT\" source=\"#j\" offset=\"1\"/>",
                              "0 5 1 6\n2 7 ")) == weights(weight + joint, "5 0 6 1 7 2"));
    CHECK(tidyCollada(weights("<input semantic=\"EXTRA\" source=\"#e\" offset=\"0\"/>"
                              "<input offset=\"2\" semantic=\"JOINT\" source=\"#j\"/>" +
                                  weight,
                              "9 0 5 9 1 6 9 2 7 9")) ==
          weights("<input offset=\"0\" semantic=\"JOINT\" source=\"#j\"/>" + weight, "5 0 6 1 7 2"));
    const std::string elsewhere = "<joints>" + weight + "</joints><v>9 0 5</v>";
    CHECK(tidyCollada(elsewhere) == elsewhere);
}

TEST_CASE("Collada's animations that move nothing in the scene are told") {
    const TemporaryFolder folder;
    std::string text = triangle("");
    text.insert(text.find("<library_visual_scenes>"),
                "<library_animations><animation id=\"a\"><source id=\"t\"><float_array id=\"ta\" count=\"1\">0"
                "</float_array><technique_common><accessor source=\"#ta\" count=\"1\" stride=\"1\"><param "
                "name=\"TIME\" type=\"float\"/></accessor></technique_common></source><sampler id=\"s\"><input "
                "semantic=\"INPUT\" source=\"#t\"/><input semantic=\"OUTPUT\" source=\"#t\"/></sampler><channel "
                "source=\"#s\" target=\"elsewhere/translate.X\"/></animation></library_animations>");
    for (const std::string& document : {text, utf16Of(text, true)}) {
        std::ofstream(folder / "moved.dae", std::ios::binary) << document;
        CHECK(warns(imported(folder / "moved.dae"), "animations"));
    }
    std::ofstream(folder / "still.dae", std::ios::binary) << triangle("");
    CHECK_FALSE(warns(imported(folder / "still.dae"), "animations"));
}

TEST_CASE("a node of a library that is shown once stands in the scene itself") {
    using rig_import::linkedCollada;
    const auto document = [](const std::string& library, const std::string& scene) {
        return "<channel/><library_nodes>" + library + "</library_nodes><visual_scene>" + scene + "</visual_scene>";
    };
    const std::string joints = "<node id=\"a\"><matrix>1</matrix><node id=\"b\"/></node>";
    const std::string shown = "<instance_node url=\"#a\"/>";
    const std::string open = "<instance_node url=\"#a\"><extra/></instance_node>";
    for (const std::string& link : {shown, open})
        CHECK(linkedCollada(document(joints, "<node>" + link + "</node>")) ==
              document("", "<node>" + joints + "</node>"));
    CHECK(linkedCollada(document(joints, shown + shown)) == document(joints, shown + shown));
    CHECK(linkedCollada(document(joints, "<node/>")) == document(joints, "<node/>"));
    // Through a second library node; a ring is cut where it is nested too deep.
    const std::string outer = "<node id=\"c\">" + shown + "</node>";
    CHECK(linkedCollada(document(joints + outer, "<instance_node url=\"#c\"/>")) ==
          document("", "<node id=\"c\">" + joints + "</node>"));
    CHECK(linkedCollada(document("<node id=\"a\">" + shown + "</node>", "<node/>")).find("<visual_scene>") !=
          std::string::npos);
    CHECK(linkedCollada("<channel/><library_nodes><node id=\"a\"><instance_node url=\"#a\"/>").size() < 4000);
}

TEST_CASE("Collada's joints move though they stand in a library of nodes") {
    const TemporaryFolder folder;
    std::string text = skinnedStrip(glm::mat4(1.0F), "other");
    const std::size_t joint = text.find("<node id=\"low\"");
    const std::size_t body = text.find("<node id=\"body\"");
    const std::string joints = text.substr(joint, body - joint);
    text.replace(joint, body - joint, "<instance_node url=\"#low\"/>");
    const auto source = [](const std::string& id, const std::string& numbers, const std::string& type, int stride) {
        return "<source id=\"" + id + "\"><float_array id=\"" + id + "a\" count=\"" + std::to_string(2 * stride) +
               "\">" + numbers + "</float_array><technique_common><accessor source=\"#" + id +
               "a\" count=\"2\" stride=\"" + std::to_string(stride) + "\"><param name=\"P\" type=\"" + type +
               "\"/></accessor></technique_common></source>";
    };
    const glm::mat4 raised = glm::translate(glm::mat4(1.0F), vec3(0, 1.3F, 0));
    text.insert(text.find("<library_visual_scenes>"),
                "<library_animations><animation id=\"a\">" + source("t", "0 1", "float", 1) +
                    source("o", numbersOf(glm::translate(glm::mat4(1.0F), vec3(0, 0.8F, 0))) + numbersOf(raised),
                           "float4x4", 16) +
                    "<sampler id=\"q\"><input semantic=\"INPUT\" source=\"#t\"/><input semantic=\"OUTPUT\" "
                    "source=\"#o\"/></sampler><channel source=\"#q\" target=\"high/matrix\"/></animation>"
                    "</library_animations><library_nodes>" +
                    joints + "</library_nodes>");
    // Channels name transforms by their sids.
    for (std::size_t at = text.find("<matrix>"); at != std::string::npos; at = text.find("<matrix>", at + 1))
        text.replace(at, 8, "<matrix sid=\"matrix\">");
    std::ofstream(folder / "library.dae", std::ios::binary) << text;
    const Character character = imported(folder / "library.dae");
    checkInvariants(character);
    CHECK_FALSE(warns(character, "animations"));
    REQUIRE(character.clips.size() == 1);
    const int high = findJoint(character.skeleton, "high");
    std::vector<RigidTransform> first(character.skeleton.parents.size());
    std::vector<RigidTransform> last = first;
    sampleClip(character.clips[0], 0.0F, first);
    sampleClip(character.clips[0], 1.0F, last);
    const float scale = character.units.metresPerFileUnit;
    CHECK(glm::distance(first[high].translation, last[high].translation) == Approx(0.5F * scale).epsilon(1e-3));
    // Two clips of it keep their names in UTF-16, too.
    const std::size_t start = text.find("<animation id");
    std::string other = text.substr(start, text.find("</library_animations>") - start);
    for (const std::string id : {"a", "t", "ta", "o", "oa", "q"}) {
        const std::string quoted = id + "\"";
        for (const std::string mark : {"\"", "#"}) {
            for (std::size_t at = other.find(mark + quoted); at != std::string::npos;
                 at = other.find(mark + quoted, at + 3))
                other.insert(at + 1, "2");
        }
    }
    const auto clip = [](const std::string& name, const std::string& animation) {
        return "<animation_clip name=\"" + name + "\"><instance_animation url=\"#" + animation +
               "\"/></animation_clip>";
    };
    text.insert(start, other);
    text.insert(text.find("</library_animations>") + 21,
                "<library_animation_clips>" + clip("walk", "a") + clip("run", "2a") + "</library_animation_clips>");
    for (const std::string& document : {text, utf16Of(text, true)}) {
        std::ofstream(folder / "clips.dae", std::ios::binary) << document;
        const Character both = imported(folder / "clips.dae");
        REQUIRE(both.clips.size() == 2);
        CHECK(both.clips[0].name == "walk");
        CHECK(both.clips[1].name == "run");
    }
}

TEST_CASE("a Collada skin over a morph, or a morph over a skin, keeps its mesh and its weights") {
    const TemporaryFolder folder;
    const std::string strip = skinnedStrip(glm::mat4(1.0F), "other");
    std::ofstream(folder / "plain.dae", std::ios::binary) << strip;
    const Character plain = imported(folder / "plain.dae");
    const auto morphOver = [](const std::string& base, const std::string& weight) {
        return "<controller id=\"m\"><morph source=\"#" + base +
               "\" method=\"NORMALIZED\"><source id=\"mt\"><IDREF_array id=\"mta\" count=\"1\">g</IDREF_array>"
               "<technique_common><accessor source=\"#mta\" count=\"1\"><param name=\"M\" type=\"IDREF\"/></accessor>"
               "</technique_common></source><source id=\"mw\"><float_array id=\"mwa\" count=\"1\">" +
               weight +
               "</float_array><technique_common><accessor source=\"#mwa\" count=\"1\"><param name=\"W\" "
               "type=\"float\"/></accessor></technique_common></source><targets><input semantic=\"MORPH_TARGET\" "
               "source=\"#mt\"/><input semantic=\"MORPH_WEIGHT\" source=\"#mw\"/></targets></morph></controller>";
    };
    for (const bool overSkin : {false, true}) {
        for (const std::string weight : {"0", "0.5"}) {
            std::string text = strip;
            const std::string link = overSkin ? "<instance_controller url=\"#c\"" : "<skin source=\"#g\"";
            text[text.find(link) + link.size() - 2] = 'm';
            text.insert(text.find("<controller"), morphOver(overSkin ? "c" : "g", weight));
            std::ofstream(folder / "morph.dae", std::ios::binary) << text;
            const Character character = imported(folder / "morph.dae");
            REQUIRE(character.meshes.size() == 1);
            CHECK(character.meshes[0].indices == plain.meshes[0].indices);
            CHECK(character.skeleton.skinWeight == plain.skeleton.skinWeight);
            CHECK(warns(character, "morph targets") == (weight != "0"));
            std::ofstream(folder / "morph.dae", std::ios::binary) << utf16Of(text, false);
            CHECK(warns(imported(folder / "morph.dae"), "morph targets") == (weight != "0"));
        }
    }
}

TEST_CASE("Collada's morph controllers stay where something still leads to them") {
    using rig_import::linkedCollada;
    const auto morph = [](const std::string& id, const std::string& source) {
        return "<controller id=\"" + id + "\"><morph source=\"#" + source + "\"/></controller>";
    };
    const auto skin = [](const std::string& source) {
        return "<controller id=\"s\"><skin source=\"#" + source + "\"/></controller>";
    };
    const auto shown = [](const std::string& id) { return "<instance_controller url=\"#" + id + "\"/>"; };
    const std::string morphs = morph("m", "n") + morph("n", "g");
    CHECK(linkedCollada(morphs + skin("m") + shown("s")) == skin("g") + shown("s"));
    // A scene shows a morph by itself: it shows what that is over.
    const std::string geometry = "<instance_geometry url=\"#g\"/>";
    CHECK(linkedCollada(morphs + skin("m") + shown("s") + shown("m")) == skin("g") + shown("s") + geometry);
    CHECK(linkedCollada(morphs + skin("m") + shown("n")) == skin("g") + geometry);
    CHECK(linkedCollada(morph("n", "g") + "<instance_controller url=\"#n\"><bind_material/></instance_controller>") ==
          "<instance_geometry url=\"#g\"><bind_material/></instance_geometry>");
    // Rings, and longer than any nesting.
    for (const int length : {2, 100}) {
        std::string ring;
        for (int i = 0; i < length; ++i)
            ring += morph("r" + std::to_string(i), "r" + std::to_string((i + 1) % length));
        ring += skin("r0") + shown("r1");
        CHECK(linkedCollada(ring) == ring);
    }
}

TEST_CASE("tidying leaves comments, character data and what is no tag as they are") {
    using rig_import::tidyCollada;
    CHECK(tidyCollada("<!--  x >  y  --> <v> 1</v>") == "<!--  x >  y  --><v>1</v>");
    CHECK(tidyCollada("<t><![CDATA[  a  > ]]> b </t>") == "<t><![CDATA[  a  > ]]>b</t>");
    CHECK(tidyCollada("<open  1  2") == "<open  1  2");
    CHECK(tidyCollada("").empty());
    // A pair of surrogates, a lone one, and an odd byte at the end.
    CHECK(tidyCollada(std::string("\xFF\xFE\x3D\xD8\x00\xDE\x3D\xD8z\0q", 11)) == "\xF0\x9F\x98\x80?z");
}

TEST_CASE("Collada's attributes may stand between any blanks and in single quotes") {
    using rig_import::tidyCollada;
    CHECK(tidyCollada("<a b=' > '  c=\"'>\">\n 1 \t 2 </a\n>") == "<a b=\" > \" c=\"'>\">1 2</a>");
    CHECK(tidyCollada("<channel\n\tsource = '#s'\r\n\ttarget=\t\"n/t\" />") ==
          "<channel source=\"#s\" target=\"n/t\"/>");
    CHECK(tidyCollada("<a b='say \"x\"'/>") == "<a b=\"say &quot;x&quot;\"/>");
    for (const char* same : {"<a b>", "<a b=c>", "<a b='1>", "<a b= >", "<a/ b=\"1\">", "<", "</", "<>", "<a =\"1\""})
        CHECK(tidyCollada(same) == same);
}

TEST_CASE("Collada's nodes have their names where the ids were made by a program") {
    using rig_import::colladaNodeNames;
    const auto names = colladaNodeNames(
        "<node id=\"id-bone-4\" sid=\"s\" name=\"pelvis\"><node name=\"upper arm.L\" id=\"Armature_upper_arm_L\"/>"
        "<node id=\"id-5\" name=\"twin\"/><node id=\"id-6\" name=\"twin\"/><node id=\"id-7\" name=\"a &amp; b\"/>"
        "<!-- <node id=\"id-8\" name=\"comment\"/> --><node id=\"id-9\"/></node>");
    CHECK(names == std::map<std::string, std::string>{{"id-bone-4", "pelvis"}});

    const TemporaryFolder folder;
    std::string text = triangle("");
    text.replace(text.find("<node id=\"n\" name=\"n\">"), 22, "<node id=\"id-1\" name=\"head\">");
    std::ofstream(folder / "named.dae", std::ios::binary) << text;
    const Character character = imported(folder / "named.dae");
    CHECK(findJoint(character.skeleton, "head") != kNoJoint);
    CHECK(findJoint(character.skeleton, "id-1") == kNoJoint);
}
