#!/usr/bin/env bash
# Installs the Debian packages that ppm is built from and tested with. Nothing to do where they are there.
#   bash apps/install_packages.sh [--optional]   also what plug-ins are built from (other people's maps), and a Slurm to test job arrays with
set -euo pipefail
packages=(
  build-essential cmake ninja-build ccache mold pkg-config git
  libeigen3-dev libembree-dev libhwy-dev libyaml-cpp-dev libcli11-dev libspdlog-dev libfmt-dev nlohmann-json3-dev
  libtbb-dev librandom123-dev libpng-dev libjpeg-dev zlib1g-dev libxxhash-dev libboost-dev libmeshoptimizer-dev libnanoflann-dev
  libopenvdb-dev libopenvdb-tools libboost-iostreams-dev
  libegl-dev libgl-dev libegl1 libgl1-mesa-dri
  catch2 libopenmesh-dev libtinygltf-dev libbenchmark-dev libmrpt-poses-dev libmrpt-obs-dev libmrpt-bayes-dev jq
)
optional=(liboctomap-dev libopen3d-dev slurmctld slurmd slurm-client munge)
case "${1:-}" in
  "") ;;
  --optional) packages+=("${optional[@]}") ;;
  *) echo "usage: apps/install_packages.sh [--optional]" >&2; exit 2 ;;
esac
missing=()
for p in "${packages[@]}"; do
  dpkg-query -W -f='${Status}' "$p" 2>/dev/null | grep -q 'ok installed' || missing+=("$p")
done
[ ${#missing[@]} -eq 0 ] && exit 0
sudo=""
[ "$(id -u)" -eq 0 ] || sudo=sudo
export DEBIAN_FRONTEND=noninteractive
echo "installing: ${missing[*]}"
$sudo apt-get update -qq
$sudo apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
