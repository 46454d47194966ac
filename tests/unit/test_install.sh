#!/bin/bash
# `cmake --install` into an empty prefix; then outside projects use what is there: find_package, pkg-config, the program.
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
prefix=$work/prefix
cmake --install "$BUILD_DIR" --prefix "$prefix" >"$work/install.log" || { cat "$work/install.log" >&2; exit 1; }

want() { [ -e "$1" ] || { echo "not installed: $1" >&2; exit 1; }; }
libdir=$(dirname "$(find "$prefix" -name 'libhalfshell.a')")
for file in "$prefix/bin/halfshell" "$prefix/include/halfshell/halfshell.h" "$prefix/include/halfshell/cells.h" "$libdir/libhalfshell.so" \
    "$libdir/pkgconfig/halfshell.pc" "$prefix/share/man/man1/halfshell.1" \
    "$prefix/share/bash-completion/completions/halfshell" "$prefix/share/zsh/site-functions/_halfshell"; do
    want "$file"
done

# The shared library shows the public functions and nothing else. (Names with _ or . in front are the compiler's.)
declared=$(grep -ohE '^HS_API[^;]*\bhs_[a-z_]+\(' "$prefix"/include/halfshell/*.h | grep -oE 'hs_[a-z_]+\(' | tr -d '(' | sort -u)
visible=$(nm -D --defined-only "$libdir/libhalfshell.so" | awk '{print $3}' | grep -v '^[_.]' | sort -u)
diff <(echo "$declared") <(echo "$visible") || { echo "symbols of libhalfshell.so differ from the headers" >&2; exit 1; }

# Each installed header stands alone, in C and (where a compiler is there) in C++.
for header in halfshell cells; do
    echo "#include <halfshell/$header.h>" >"$work/alone.c"
    "$CC" -std=c99 -Wall -Wextra -Werror -pedantic -I"$prefix/include" -c "$work/alone.c" -o "$work/alone.o"
    if command -v c++ >/dev/null 2>&1; then
        c++ -x c++ -Wall -Wextra -Werror -I"$prefix/include" -c "$work/alone.c" -o "$work/alone.o"
    fi
done

flags=()
grep -q '^HALFSHELL_SANITIZE:.*=ON' "$BUILD_DIR/CMakeCache.txt" && flags=("-fsanitize=address,undefined")

version=$("$prefix/bin/halfshell" --version)
check_output() {
    "$@" >"$work/out" || { cat "$work/out" >&2; exit 1; }
    [ "$(grep -c "^version ${version#halfshell } atoms 256 step 10 etotal" "$work/out")" -eq 2 ] ||
        { echo "$*: unexpected output:" >&2; cat "$work/out" >&2; exit 1; }
}

cmake -G Ninja -S "$PROJECT_ROOT/tests/package" -B "$work/cmake" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_C_FLAGS="${flags[*]-}" \
    >"$work/configure.log" 2>&1 || { cat "$work/configure.log" >&2; exit 1; }
cmake --build "$work/cmake" >"$work/build.log" 2>&1 || { cat "$work/build.log" >&2; exit 1; }
check_output "$work/cmake/with_shared"
cp "$work/out" "$work/out.shared"
check_output "$work/cmake/with_static"
diff "$work/out.shared" "$work/out"

export PKG_CONFIG_PATH=$libdir/pkgconfig
read -ra pc < <(pkg-config --cflags --libs halfshell)
"$CC" "${flags[@]}" "$PROJECT_ROOT/tests/package/main.c" "${pc[@]}" -Wl,-rpath,"$libdir" -o "$work/with_pkgconfig"
check_output "$work/with_pkgconfig"
diff "$work/out.shared" "$work/out"
[ "$(pkg-config --modversion halfshell)" = "${version#halfshell }" ]

# The example programs, as their heads say they are built: with CMake and with pkg-config. The flock of vicsek.c aligns.
cmake -G Ninja -S "$PROJECT_ROOT/examples" -B "$work/examples" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_C_FLAGS="${flags[*]-}" \
    >"$work/configure.log" 2>&1 || { cat "$work/configure.log" >&2; exit 1; }
cmake --build "$work/examples" >"$work/build.log" 2>&1 || { cat "$work/build.log" >&2; exit 1; }
read -ra pc < <(pkg-config --cflags --libs halfshell)
"$CC" "${flags[@]}" "$PROJECT_ROOT/examples/vicsek.c" -o "$work/vicsek" "${pc[@]}" -Wl,-rpath,"$libdir" -lm
for program in "$work/vicsek" "$work/examples/vicsek"; do
    "$program" 500 300 0.3 >"$work/out"
    tail -1 "$work/out" | awk '$1 == 300 && $2 > 0.8 { found = 1 } END { exit !found }' ||
        { echo "vicsek: the flock does not align:" >&2; tail -3 "$work/out" >&2; exit 1; }
done
