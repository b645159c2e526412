// Models of MikuMikuDance.

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include "animation/import/checks.hpp"
#include "animation/import/gltf_file.hpp"
#include "support/catch.hpp"

using namespace lutka;
using namespace lutka::animation;
using namespace lutka::test;

namespace {

// A PMX 2.0 file as far as a post of one triangle with one joint needs it: indices of one byte but for vertices' two,
// texts in UTF-8.
class PmxFile {
  public:
    explicit PmxFile(float height) {
        bytes_ = "PMX ";
        number(2.0F);
        for (const int global : {8, 1, 0, 2, 1, 1, 1, 1, 1})
            byte(global);
        for (const char* name : {"post", "post", "", ""})
            text(name);
        count(3);
        for (const vec3& position : {vec3(-0.5F, 0, 0), vec3(0.5F, 0, 0), vec3(0, height, 0)})
            vertex(position);
        count(3);
        for (const int index : {0, 1, 2}) {
            byte(index);
            byte(0);
        }
        count(0);  // textures
        count(1);
        material();
        count(1);
        joint("centre");
        for (int list = 0; list < 4; ++list)  // morphs, frames, rigid bodies, joints of these
            count(0);
    }

    void save(const std::string& path) const { std::ofstream(path, std::ios::binary) << bytes_; }

  private:
    void byte(int value) { bytes_.push_back(static_cast<char>(value)); }
    template <class T>
    void raw(T value) {
        char bytes[sizeof(T)];
        std::memcpy(bytes, &value, sizeof(T));
        bytes_.append(bytes, sizeof(T));
    }
    void number(float value) { raw(value); }
    void numbers(const std::vector<float>& values) {
        for (const float value : values)
            number(value);
    }
    void count(std::int32_t value) { raw(value); }
    void text(const std::string& value) {
        count(static_cast<std::int32_t>(value.size()));
        bytes_ += value;
    }
    void vertex(const vec3& position) {
        numbers({position.x, position.y, position.z, 0, 0, -1, 0, 0});  // with normal and UV
        byte(0);                                                        // one joint,
        byte(0);                                                        // the first
        number(1.0F);                                                   // edge
    }
    void material() {
        text("grey");
        text("grey");
        numbers({0.5F, 0.5F, 0.5F, 1, 0, 0, 0, 1, 0.2F, 0.2F, 0.2F});  // diffuse, specular, ambient
        byte(0);
        numbers({0, 0, 0, 1, 1});  // edge
        byte(-1);                  // texture
        byte(-1);                  // sphere map
        byte(0);
        byte(1);  // a shared toon,
        byte(0);  // the first
        text("");
        count(3);
    }
    void joint(const std::string& name) {
        text(name);
        text(name);
        numbers({0, 1, 0});
        byte(-1);  // parent
        count(0);  // layer
        byte(0x1E);
        byte(0);
        numbers({0, 1, 0});  // tail
    }

    std::string bytes_;
};

}  // namespace

TEST_CASE("a unit of MikuMikuDance is 8 cm") {
    const TemporaryFolder folder;
    PmxFile(22.0F).save(folder / "post.pmx");
    const Character post = imported(folder / "post.pmx");
    CHECK(post.units.metresPerFileUnit == Approx(0.08F));
    REQUIRE(post.meshes.size() == 1);
    const auto lower = [](const vec3& a, const vec3& b) { return a.y < b.y; };
    const std::vector<vec3>& positions = post.meshes[0].positions;
    const auto [lowest, highest] = std::minmax_element(positions.begin(), positions.end(), lower);
    CHECK(highest->y - lowest->y == Approx(1.76F));
}
