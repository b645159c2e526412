# Sourced by tools/run and tools/test: packages, configure, build. Debian 12 (bookworm); needs bash, and apt for what is
# missing. Prints what it does, and asks for nothing when everything is there.

LUTKA_ROOT=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)

# The executable finds the assets by its own place; where /proc is not mounted (a bare chroot) it needs to be told.
export LUTKA_ASSETS=${LUTKA_ASSETS:-$LUTKA_ROOT/assets}

# What the build needs: tools; physics; import (zlib and minizip are what assimp asks its users to link), window and GL;
# maths, UI; data; logs, threads, tests.
LUTKA_BUILD_PACKAGES=(
  g++ cmake ninja-build ccache pkg-config python3-glad
  libbullet-dev libassimp-dev zlib1g-dev libminizip-dev libdraco-dev libmeshoptimizer-dev libglfw3-dev libgl-dev libegl-dev libgl1-mesa-dri libegl1
  libglm-dev libimgui-dev nlohmann-json3-dev libcli11-dev libtinygltf-dev libstb-dev
  libspdlog-dev libfmt-dev libtbb-dev catch2
)
LUTKA_RUN_PACKAGES=(ffmpeg fonts-dejavu-core libjs-three)
LUTKA_TEST_PACKAGES=(clang-format-14 clang-tidy-14 xvfb xauth xdotool python3 python3-numpy python3-jsonschema)
LUTKA_TEST_PACKAGES+=(pybind11-dev python3-dev python3-pytest)

LUTKA_PACKAGE_PACKAGES=(dpkg-dev help2man)
# Readers of what is exported (tests/witness). npm comes with the nodejs of other sources than Debian.
LUTKA_WITNESS_PACKAGES=(libmujoco-dev godot3-server blender liburdfdom-tools chromium)
LUTKA_WITNESS_PACKAGES+=(parallel slurm-wlm munge)  # ways to run a batch
command -v npm >/dev/null || LUTKA_WITNESS_PACKAGES+=(nodejs npm)
LUTKA_FUZZ_PACKAGES=(clang-14 libclang-rt-14-dev)

say() { printf '\033[1m==> %s\033[0m\n' "$*" >&2; }
fail() { printf 'lutka: %s\n' "$*" >&2; exit 1; }

# install_missing PACKAGE...: by apt, only those that are not there.
install_missing() {
  local missing=() package
  for package in "$@"; do
    dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null | grep -qx installed || missing+=("$package")
  done
  [ ${#missing[@]} -eq 0 ] && return 0
  command -v apt-get >/dev/null || fail "these packages are missing and apt-get is not there: ${missing[*]}"
  local as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || fail "these packages are missing; install them as root: ${missing[*]}"
    as_root=(sudo)
  fi
  say "installing by apt: ${missing[*]}"
  "${as_root[@]}" apt-get update -qq || fail "apt-get update failed"
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" \
    >/dev/null || fail "apt-get could not install: ${missing[*]}"
}

# configure_and_build [-DNAME=VALUE ...] -- [TARGET ...]: the release preset, in build/. A unity build: half the processor
# time of a first build.
configure_and_build() {
  local definitions=()
  while [ $# -gt 0 ] && [ "$1" != -- ]; do definitions+=("$1"); shift; done
  [ "${1:-}" = -- ] && shift
  say "configuring (release, Ninja)"
  (cd "$LUTKA_ROOT" && cmake --preset release -DLUTKA_UNITY_BUILD=ON "${definitions[@]}" >build.log 2>&1) ||
    { cat "$LUTKA_ROOT/build.log" >&2; rm -f "$LUTKA_ROOT/build.log"; fail "cmake could not configure the build"; }
  rm -f "$LUTKA_ROOT/build.log"
  say "building"
  local targets=() target
  for target in "$@"; do targets+=(--target "$target"); done
  # As many compilers as processors: two more, Ninja's own choice, cost memory and cache and win no time.
  cmake --build "$LUTKA_ROOT/build" --parallel "$(nproc)" "${targets[@]}" >&2 || fail "the build failed"
}
