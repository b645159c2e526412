// Find out which joint plays which part, without physics.
#include <cstdio>

#include "animation/humanoid/map_humanoid.hpp"
#include "animation/import/import_character.hpp"

using namespace lutka;

int main(int argc, char** argv) {
    if (argc != 2) return 2;
    // [howto]
    const auto character = animation::importCharacter(argv[1]);
    if (!character) {
        std::fprintf(stderr, "%s\n", character.error().text().c_str());
        return 3;
    }
    const animation::HumanoidMap map = animation::mapHumanoid(character.value());
    for (const std::string& warning : map.warnings)
        std::fprintf(stderr, "%s\n", warning.c_str());
    if (!map.humanoid) return 3;  // the reason is among the warnings
    for (std::size_t index = 0; index < map.roles.size(); ++index) {
        const auto role = static_cast<animation::Role>(index);
        const auto& binding = map[role];
        if (!binding) continue;
        std::printf("%-20s %-20s %.2f  %s\n", std::string(animation::roleName(role)).c_str(),
                    character.value().skeleton.names[static_cast<std::size_t>(binding->joint)].c_str(),
                    static_cast<double>(binding->confidence), binding->reason.c_str());
    }
    // [/howto]
    return 0;
}
