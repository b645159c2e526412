#include "fuzz/fuzz_target.hpp"
#include "physics/fit/fit_ragdoll.hpp"
#include "physics/profile/profile_io.hpp"
#include "random_figure.hpp"

using namespace lutka;

namespace {

// As the mapper has it, or as a user who assigns roles at will.
animation::HumanoidMap mapOf(const animation::Character& figure, fuzz::Bytes& bytes) {
    animation::HumanoidMap map = animation::mapHumanoid(figure);
    if (map.humanoid) return map;
    map = {};
    map.humanoid = true;
    const int joints = figure.skeleton.jointCount();
    for (std::size_t role = 0; role < map.roles.size(); ++role) {
        const int joint = static_cast<int>(role) < joints ? static_cast<int>(role) : bytes.next();
        if (joint < joints && bytes.next() % 8 != 7) map.roles[role] = animation::RoleBinding{joint, 1.0F, "fuzz"};
    }
    return map;
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::Bytes bytes(data, size);
    const animation::Character figure = fuzz::figureFrom(bytes);
    const auto profile = physics::fitRagdoll(figure, mapOf(figure, bytes));
    if (!profile) return 0;
    // What is fitted is sound, and reads as itself again.
    fuzz::promise(physics::validate(profile.value()).empty());
    fuzz::promise(physics::profileFromJson(physics::profileToJson(profile.value()), "again").ok());
    return 0;
}
