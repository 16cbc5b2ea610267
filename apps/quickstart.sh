#!/usr/bin/env bash
# From a fresh Debian 12 to a first map: installs, builds, runs SLAM in the embedded room, says where the results are.
set -euo pipefail
cd "$(dirname "$0")/.."
bash apps/install_packages.sh
cmake --preset release
cmake --build --preset release --target ppm
build/bin/ppm run configs/room.yaml --out runs/quickstart --force
echo
echo "Picture: $PWD/runs/quickstart/map.png"
echo "Mesh:    $PWD/runs/quickstart/map.ply"
