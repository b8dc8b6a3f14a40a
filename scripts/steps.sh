# For scripts that do one step after the other: step NAME names the step that begins, steps_done prints how long each
# took. A step that fails ends the script with its name.
set -Eeuo pipefail

# Many tests wait for a program that they have started, so there is time for one more than there are processors.
tests_at_once=$(($(nproc) + 1))

step() {
  end_step
  current=$1
  began=$SECONDS
  echo
  echo "== $current"
}

end_step() {
  [[ -z "${current:-}" ]] || times+=("$(printf '%5d s  %s' $((SECONDS - began)) "$current")")
  current=
}

steps_done() {
  end_step
  printf '\n%s\n' "Time by step:"
  printf '%s\n' "${times[@]}"
}

times=()
trap 'echo "$0: FAILED: $current" >&2' ERR
