#!/usr/bin/env bash
# Installs what is missing, builds, runs every test.
#   bash tests/run.sh                      release build, whole suite
#   bash tests/run.sh --sanitize address   the suite under AddressSanitizer and UBSan
#   bash tests/run.sh --sanitize thread    the parallel parts under ThreadSanitizer
#   bash tests/run.sh -- -R slam           further arguments go to ctest
set -euo pipefail
cd "$(dirname "$0")/.."
preset=release
while [ $# -gt 0 ]; do
  case "$1" in
    --sanitize)
      case "${2:-}" in
        address) preset=asan ;;
        thread) preset=tsan ;;
        *) echo "usage: tests/run.sh [--sanitize address|thread] [-- CTEST-ARGUMENTS]" >&2; exit 2 ;;
      esac
      shift 2 ;;
    --) shift; break ;;
    *) echo "usage: tests/run.sh [--sanitize address|thread] [-- CTEST-ARGUMENTS]" >&2; exit 2 ;;
  esac
done
bash apps/install_packages.sh --optional
cmake --preset "$preset"
cmake --build --preset "$preset"
exec ctest --preset "$preset" "$@"
