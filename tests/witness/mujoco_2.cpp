// Prints as JSON what MuJoCo 2.2.2 (Debian's libmujoco-dev) makes of an MJCF file, and where it rests after 6 s.
#include <mujoco/mujoco.h>

#include <cmath>
#include <cstdio>

namespace {

void printArray(const char* key, const mjtNum* values, int count, const char* after) {
    std::printf("\"%s\": [", key);
    for (int i = 0; i < count; ++i)
        std::printf("%s%.17g", i > 0 ? ", " : "", values[i]);
    std::printf("]%s", after);
}

}  // namespace

int main(int argc, char** argv) {
    mju_user_warning = [](const char* text) { std::fprintf(stderr, "%s\n", text); };  // else on stdout, in the JSON
    char error[1000] = "no file";
    mjModel* m = argc == 2 ? mj_loadXML(argv[1], nullptr, error, sizeof error) : nullptr;
    if (m == nullptr) {
        std::fprintf(stderr, "%s\n", error);
        return 1;
    }
    std::printf("{\"bodies\": {");
    for (int i = 1; i < m->nbody; ++i) {
        std::printf("%s\"%s\": {\"mass\": %.17g, ", i > 1 ? ", " : "", mj_id2name(m, mjOBJ_BODY, i), m->body_mass[i]);
        printArray("inertia", m->body_inertia + 3 * i, 3, ", ");
        printArray("ipos", m->body_ipos + 3 * i, 3, ", \"geoms\": [");
        for (int k = 0; k < m->body_geomnum[i]; ++k) {
            const int geom = m->body_geomadr[i] + k;
            std::printf("%s{\"type\": %d, ", k > 0 ? ", " : "", m->geom_type[geom]);
            printArray("size", m->geom_size + 3 * geom, 3, "}");
        }
        std::printf("]}");
    }
    std::printf("}, \"joints\": {");
    for (int i = 1; i < m->njnt; ++i) {
        std::printf("%s\"%s\": {\"friction\": %.17g, ", i > 1 ? ", " : "", mj_id2name(m, mjOBJ_JOINT, i),
                    m->dof_frictionloss[m->jnt_dofadr[i]]);
        printArray("pos", m->jnt_pos + 3 * i, 3, ", ");
        printArray("axis", m->jnt_axis + 3 * i, 3, ", ");
        printArray("range", m->jnt_range + 2 * i, 2, "}");
    }
    mjData* d = mj_makeData(m);
    mj_resetDataKeyframe(m, d, 0);
    // On its back, 1 m up: a turn by -90 degrees about y.
    const mjtNum turn[4] = {std::sqrt(0.5), 0, -std::sqrt(0.5), 0};
    mjtNum turned[4];
    mju_mulQuat(turned, turn, d->qpos + 3);
    mju_copy4(d->qpos + 3, turned);
    d->qpos[0] = d->qpos[1] = 0.0;
    d->qpos[2] = 1.0;
    for (int i = 0; i < static_cast<int>(6.0 / m->opt.timestep); ++i)
        mj_step(m, d);
    bool finite = true;
    for (int i = 0; i < m->nq; ++i)
        finite = finite && std::isfinite(d->qpos[i]);
    std::printf("}, \"excludes\": %d, \"tendons\": %d, \"rest\": %.17g, \"finite\": %s}\n", m->nexclude, m->ntendon,
                d->subtree_com[2], finite ? "true" : "false");
    mj_deleteData(d);
    mj_deleteModel(m);
}
