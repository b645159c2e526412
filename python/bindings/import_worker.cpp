// Reads one model in a process of its own, for the module (animation::ImportWorker).
#include <string>
#include <vector>

#include "animation/import/import_character.hpp"

int main(int argc, char** argv) {
    if (argc < 2 || !lutka::animation::asksForImport(argv[1])) return 2;
    return lutka::animation::serveImport(std::vector<std::string>(argv + 1, argv + argc));
}
