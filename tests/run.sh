#!/usr/bin/env bash
# Installs what is missing (Debian 12), builds and tests everything: about 20 minutes on two cores from nothing.
#
#   tests/run.sh              all sections
#   tests/run.sh --quick      format and gcc only
#   tests/run.sh gcc tidy     these sections: format gcc tidy clang native asan tsan docs
#   tests/run.sh fuzz         a section that is not among the usual ones; LIGHTCUTS_FUZZ_SECONDS (60) for each target
#   tests/run.sh --list       says what each section does
#
# LIGHTCUTS_BUILD is where the builds go (build/ in the repository). The last line is `N passed, N failed`: tests of
# all sections, and one for each section that is a check of its own. The exit status is 0 if nothing failed.
set -euo pipefail
root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"
source .ci/packages.sh
build=${LIGHTCUTS_BUILD:-$root/build}
jobs=$(nproc)
sections=(format gcc tidy clang native asan tsan docs)
more_sections=(fuzz)

usage() { sed -n '2,/^set/p' "$root/tests/run.sh" | sed -n 's/^# \{0,1\}//p'; }

describe() {
    cat <<'END'
format  clang-format over all sources
gcc     g++, Release, everything: tests, examples, renderer, compile-time failures, consumers, benchmarks (built)
tidy    clang-tidy over the headers
clang   clang++, Release: the library's tests
native  g++ and clang++ for this very processor, products and sums contracted: the tests of bounds and cuts
asan    AddressSanitizer and UndefinedBehaviorSanitizer: the library's tests
tsan    ThreadSanitizer: the library's tests that use threads
docs    Doxygen
fuzz    libFuzzer: what reads files, with bytes that it makes up (not among the usual sections)
END
}

chosen=()
for argument in "$@"; do
    case $argument in
        --quick) chosen+=(format gcc) ;;
        --list) describe; exit 0 ;;
        -h | --help) usage; exit 0 ;;
        *)
            case " ${sections[*]} ${more_sections[*]} " in
                *" $argument "*) chosen+=("$argument") ;;
                *) echo "tests/run.sh: no section or option \`$argument\`; see --help" >&2; exit 2 ;;
            esac
            ;;
    esac
done
if [ ${#chosen[@]} -eq 0 ]; then
    chosen=("${sections[@]}")
fi

if ! install_packages "${library_packages[@]}" "${renderer_packages[@]}" "${window_packages[@]}" \
    "${test_packages[@]}"; then
    echo "0 passed, 1 failed"
    exit 1
fi
if command -v ccache >/dev/null; then
    export CMAKE_CXX_COMPILER_LAUNCHER=ccache CCACHE_BASEDIR=$root CCACHE_NOHASHDIR=1
fi
export CTEST_PARALLEL_LEVEL=$jobs CMAKE_BUILD_PARALLEL_LEVEL=$jobs

passed=0
failed=0
failures=()

# check NAME COMMAND...: counts as one test.
check() {
    local name=$1
    shift
    if "$@"; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        failures+=("$name")
    fi
}

# compile PRESET COMPILER [build options]: configures and builds build/PRESET.
compile() {
    local preset=$1 compiler=$2
    shift 2
    cmake --preset "$preset" -B "$build/$preset" -D CMAKE_CXX_COMPILER="$compiler" \
        >"$build/$preset.configure.log" 2>&1 || { cat "$build/$preset.configure.log"; return 1; }
    cmake --build "$build/$preset" "$@" -- -k 0
}

# run_tests PRESET [ctest options]: adds ctest's own totals to ours.
run_tests() {
    local preset=$1 log=$build/$1.ctest.log totals
    shift
    ctest --test-dir "$build/$preset" --output-on-failure --progress "$@" </dev/null >"$log" 2>&1 || true
    # Only what failed, and the closing lines.
    sed -n '/\*\*\*\|^[^ ]*% tests passed/,$p' "$log"
    totals=$(sed -n 's/^.*% tests passed, \([0-9]*\) tests* failed out of \([0-9]*\).*/\1 \2/p' "$log" | tail -n 1)
    if [ -z "$totals" ]; then
        tail -n 20 "$log"
        check "$preset: no test ran" false
    else
        local bad=${totals% *} all=${totals#* }
        passed=$((passed + all - bad))
        failed=$((failed + bad))
        if [ "$bad" -ne 0 ]; then
            failures+=("$preset: $bad tests")
        fi
    fi
}

compile_and_test() {
    local preset=$1 compiler=$2
    shift 2
    if ! compile "$preset" "$compiler"; then
        check "$preset: build" false
    fi
    run_tests "$preset" "$@"
}

sources() { find include examples tests benchmarks \( -name '*.hpp' -o -name '*.cpp' \) -print0; }

section_format() {
    format() {
        local said
        if ! said=$(sources | xargs -0 clang-format --dry-run -Werror 2>&1); then
            echo "Run clang-format -i on:"
            sed -n 's/:[0-9]*:[0-9]*: error:.*//p' <<<"$said" | sort -u | grep . || echo "$said"
            return 1
        fi
    }
    check format format
}

section_gcc() { compile_and_test release g++; }

section_tidy() {
    tidy() {
        cmake --preset clang-tidy -B "$build/clang-tidy" >"$build/clang-tidy.configure.log" 2>&1 ||
            { cat "$build/clang-tidy.configure.log"; return 1; }
        cmake --build "$build/clang-tidy" --target tidy
    }
    check tidy tidy
}

section_clang() { compile_and_test clang clang++ -L unit; }

# What contraction may break: numerics, and laws about them.
section_native() {
    local preset
    for preset in native native-clang; do
        local compiler=g++
        if [ "$preset" = native-clang ]; then
            compiler=clang++
        fi
        if ! compile "$preset" "$compiler" --target test-core test-bound test-cut test-laws; then
            check "$preset: build" false
        fi
        run_tests "$preset" -R '^(core|bound|cut|laws)\.'
    done
}

section_asan() { compile_and_test asan-ubsan g++ -L unit; }

section_tsan() { compile_and_test tsan g++ -L unit -R '[Tt]hread|[Ee]xecutor'; }

section_docs() {
    docs() {
        cmake --preset release -B "$build/docs" -D LIGHTCUTS_TESTS=OFF -D LIGHTCUTS_EXAMPLES=OFF \
            -D LIGHTCUTS_RENDERER=OFF -D LIGHTCUTS_BENCHMARKS=OFF >"$build/docs.configure.log" 2>&1 ||
            { cat "$build/docs.configure.log"; return 1; }
        cmake --build "$build/docs" --target docs
    }
    check docs docs
}

# Inputs that lead on, and any that break a target, are kept in build/fuzz-corpus/TARGET.
section_fuzz() {
    local seconds=${LIGHTCUTS_FUZZ_SECONDS:-60} source target corpus
    if ! install_packages "${fuzz_packages[@]}" || ! compile fuzz clang++ --target fuzz-targets; then
        check "fuzz: build" false
        return
    fi
    for source in tests/fuzz/fuzz_*.cpp; do
        target=$(basename "$source" .cpp)
        corpus=$build/fuzz-corpus/${target#fuzz_}
        mkdir -p "$corpus"
        fuzz() {
            local log=$corpus.log
            "$build/fuzz/fuzz/$target" "$corpus" "tests/fuzz/corpus/${target#fuzz_}" -max_total_time="$seconds" \
                -max_len=8192 -timeout=20 -rss_limit_mb=4096 -print_final_stats=1 -artifact_prefix="$corpus-" \
                >"$log" 2>&1 || { tail -n 40 "$log"; return 1; }
            sed -n "s/^stat::number_of_executed_units: */$target: executions /p" "$log"
        }
        check "$target" fuzz
    done
}

mkdir -p "$build"
started=$SECONDS
for section in "${chosen[@]}"; do
    echo "=== $section"
    section_started=$SECONDS
    "section_$section"
    echo "=== $section: $((SECONDS - section_started)) s"
done

echo "All sections: $((SECONDS - started)) s"
for failure in ${failures[@]+"${failures[@]}"}; do
    echo "FAILED: $failure"
done
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ] && [ "$passed" -gt 0 ]
