# To be sourced: runs the phases of a longer job, says which one is running and how long each took.

phase_names=()
phase_seconds=()

# phase NAME COMMAND...: stops the script with status 1 when the command fails.
phase() {
  local name="$1" begin="$SECONDS"
  shift
  printf '\n== %s\n' "$name"
  if ! "$@"; then
    printf '== %s: FAILED after %d s\n' "$name" "$((SECONDS - begin))"
    exit 1
  fi
  phase_names+=("$name")
  phase_seconds+=("$((SECONDS - begin))")
  printf '== %s: done in %d s\n' "$name" "$((SECONDS - begin))"
}

print_phases() {
  printf '\n'
  local i
  for i in "${!phase_names[@]}"; do
    printf '%6d s  %s\n' "${phase_seconds[i]}" "${phase_names[i]}"
  done
}

# How many processes to run at once: one a core, or so many more, but no more than memory allows (a compiler takes up to 2 GB).
parallel_jobs() {  # [HOW MANY MORE THAN CORES]
  local cores memory_kb fitting
  cores=$(($(nproc) + ${1:-0}))
  memory_kb="$(awk '/^MemAvailable:/ {print $2}' /proc/meminfo)"
  fitting=$((memory_kb / 2000000))
  ((fitting < 1)) && fitting=1
  echo $((cores < fitting ? cores : fitting))
}
