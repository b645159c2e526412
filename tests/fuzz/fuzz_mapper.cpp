#include <cmath>

#include "animation/humanoid/map_humanoid.hpp"
#include "fuzz/fuzz_target.hpp"
#include "random_figure.hpp"

using namespace lutka;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::Bytes bytes(data, size);
    const animation::Character figure = fuzz::figureFrom(bytes);
    fuzz::promise(animation::validate(figure.skeleton).empty());
    const animation::HumanoidMap map = animation::mapHumanoid(figure);
    fuzz::promise(map.confidence >= 0.0F && map.confidence <= 1.0F);
    fuzz::promise(std::abs(glm::length(map.standardFromModel) - 1.0F) < 1e-3F);
    for (const auto& role : map.roles)
        fuzz::promise(!role || (role->joint >= 0 && role->joint < figure.skeleton.jointCount()));
    return 0;
}
