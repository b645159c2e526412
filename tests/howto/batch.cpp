// Make a profile of every model of a folder, and go on where one is no humanoid.
#include <cstdio>
#include <filesystem>

#include "physics/profile/profile_io.hpp"
#include "scene/asset/ragdoll_asset.hpp"

using namespace lutka;

int main(int argc, char** argv) {
    if (argc != 3) return 2;
    int made = 0;
    // [howto]
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(argv[1], error)) {
        if (entry.path().extension() != ".glb") continue;
        const auto ragdoll = scene::loadRagdoll(entry.path());
        if (!ragdoll) {
            std::fprintf(stderr, "%s\n", ragdoll.error().text().c_str());
            continue;
        }
        const auto file = std::filesystem::path(argv[2]) / entry.path().stem().concat(".ragdoll.json");
        if (const auto written = physics::saveProfile(file, ragdoll.value()->profile); !written) {
            std::fprintf(stderr, "%s\n", written.error().text().c_str());
            return 5;
        }
        ++made;
    }
    if (error) std::fprintf(stderr, "%s: %s\n", argv[1], error.message().c_str());
    // [/howto]
    std::printf("%d profiles\n", made);
    return made > 0 ? 0 : 3;
}
