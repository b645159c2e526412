#include "animation/import/collada_file.hpp"

#include <sstream>

namespace lutka::test {
namespace {

std::string joined(const std::vector<float>& numbers) {
    std::ostringstream out;
    out.precision(9);
    for (const float number : numbers)
        out << number << ' ';
    return out.str();
}

std::string source(const std::string& id, const std::vector<float>& numbers, int stride, const std::string& params) {
    const std::string count = std::to_string(numbers.size());
    return "<source id=\"" + id + "\"><float_array id=\"" + id + "-a\" count=\"" + count + "\">" + joined(numbers) +
           "</float_array><technique_common><accessor source=\"#" + id + "-a\" count=\"" +
           std::to_string(numbers.size() / static_cast<std::size_t>(stride)) + "\" stride=\"" + std::to_string(stride) +
           "\">" + params + "</accessor></technique_common></source>";
}

constexpr const char* kXyz =
    "<param name=\"X\" type=\"float\"/><param name=\"Y\" type=\"float\"/><param name=\"Z\" type=\"float\"/>";

}  // namespace

std::string ColladaFile::text() const {
    std::vector<float> positions;
    for (const float height : {0.0F, 0.6F, 1.2F, 1.8F})
        positions.insert(positions.end(), {-0.1F, height, 0, 0.1F, height, 0});
    std::vector<float> binds;
    for (const float height : {0.0F, 0.6F, 1.2F})
        binds.insert(binds.end(), {1, 0, 0, 0, 0, 1, 0, -height, 0, 0, 1, 0, 0, 0, 0, 1});
    return "<?xml version=\"1.0\"?><COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" "
           "version=\"1.4.1\"><asset><unit meter=\"1\" name=\"meter\"/><up_axis>Y_UP</up_axis></asset>"
           "<library_geometries><geometry id=\"g\"><mesh>" +
           source("p", positions, 3, kXyz) +
           "<vertices id=\"v\"><input semantic=\"POSITION\" source=\"#p\"/></vertices><triangles count=\"6\"><input "
           "semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><p>0 1 2 1 3 2 2 3 4 3 5 4 4 5 6 5 7 6</p></triangles>"
           "</mesh></geometry></library_geometries><library_controllers><controller id=\"c\"><skin source=\"#g\">"
           "<bind_shape_matrix>1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</bind_shape_matrix><source id=\"j\"><" +
           jointList + " id=\"j-a\" count=\"3\">" + jointNames + "</" + jointList +
           "><technique_common><accessor source=\"#j-a\" count=\"3\"><param name=\"JOINT\" type=\"name\"/></accessor>"
           "</technique_common></source>" +
           source("b", binds, 16, "<param name=\"TRANSFORM\" type=\"float4x4\"/>") +
           source("w", {1}, 1, "<param name=\"WEIGHT\" type=\"float\"/>") +
           "<joints><input semantic=\"JOINT\" source=\"#j\"/><input semantic=\"INV_BIND_MATRIX\" source=\"#b\"/>"
           "</joints><vertex_weights count=\"8\"><input semantic=\"JOINT\" source=\"#j\" offset=\"0\"/><input "
           "semantic=\"WEIGHT\" source=\"#w\" offset=\"1\"/><vcount>1 1 1 1 1 1 1 1</vcount>"
           "<v>0 0 0 0 1 0 1 0 1 0 1 0 2 0 2 0</v></vertex_weights></skin></controller></library_controllers>" +
           (animations.empty() ? "" : "<library_animations>" + animations + "</library_animations>") + clips +
           "<library_visual_scenes><visual_scene id=\"s\">" + nodes + "</visual_scene></library_visual_scenes>" +
           scene + "</COLLADA>";
}

std::string colladaJoints(const std::string& prefix, float turnOfHighDeg) {
    const auto joint = [&](const std::string& name, const std::string& height, const std::string& turn,
                           const std::string& inner) {
        return "<node id=\"" + prefix + name + "\" sid=\"" + name + "\" name=\"" + name +
               "\" type=\"JOINT\"><translate sid=\"t\">0 " + height + " 0</translate><rotate sid=\"rz\">0 0 1 " + turn +
               "</rotate><matrix sid=\"m\">1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</matrix>" + inner + "</node>";
    };
    return joint("low", "0", "0", joint("middle", "0.6", "0", joint("high", "0.6", std::to_string(turnOfHighDeg), "")));
}

std::string colladaBody(const std::string& id, const std::string& skeleton) {
    return "<node id=\"" + id + "\"><instance_controller url=\"#c\">" +
           (skeleton.empty() ? "" : "<skeleton>#" + skeleton + "</skeleton>") + "</instance_controller></node>";
}

std::string colladaChannel(const std::string& id, const std::string& target, const std::vector<float>& times,
                           const std::vector<float>& values, int stride, const std::string& params) {
    return source(id + "-t", times, 1, "<param name=\"TIME\" type=\"float\"/>") +
           source(id + "-v", values, stride, params) + "<sampler id=\"" + id +
           "-s\"><input semantic=\"INPUT\" source=\"#" + id + "-t\"/><input semantic=\"OUTPUT\" source=\"#" + id +
           "-v\"/></sampler><channel source=\"#" + id + "-s\" target=\"" + target + "\"/>";
}

}  // namespace lutka::test
