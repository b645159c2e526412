#pragma once

#include <string>
#include <vector>

namespace lutka {

/// What posix_spawn takes as argv: pointers into `arguments`, which must outlive them, and null at the end.
[[nodiscard]] inline std::vector<char*> spawnArguments(const std::vector<std::string>& arguments) {
    std::vector<char*> argv;
    argv.reserve(arguments.size() + 1);
    for (const std::string& argument : arguments)
        argv.push_back(const_cast<char*>(argument.c_str()));  // posix_spawn leaves them alone
    argv.push_back(nullptr);
    return argv;
}

}  // namespace lutka
