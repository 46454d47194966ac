#!/bin/bash
# One bit of a file has flipped, or its end is missing, at places all over it: a checkpoint is refused; a trajectory that is added to or
# read, and a data file, are refused or taken, with a message and without a crash, a hang, or a file of which more is lost.
# HALFSHELL_FLIPS=N takes N places of each file (a study; the test takes few).
set -eu
. "$PROJECT_ROOT/tests/support/folder.sh"
n_places=${HALFSHELL_FLIPS:-8}

cat >system.in <<'END'
lattice fcc 0.8442
region box block 0 2 0 2 0 2
create_box 1 box
create_atoms 1 box
mass 1 1.0
velocity all create 1.44 87287
END
cat >forces.in <<'END'
pair_style lj/cut 1.2
pair_coeff 1 1 1.0 1.0
fix 1 all nve
thermo 1
END
cat system.in forces.in - >first.in <<'END'
dump d all h5md 1 whole.h5 position velocity image
run 3
undump d
write_data whole.data
write_restart whole.chk
END
"$HALFSHELL" first.in -log none >out 2>&1 || fail "$(cat out)"
cat system.in forces.in - >append.in <<'END'
reset_timestep 3
dump d all h5md 1 bad position velocity image
dump_modify d append yes
run 2
END
cat system.in forces.in - >rerun.in <<'END'
rerun bad dump x y z vx vy vz
END
{ echo 'read_data bad nocoeff'; cat forces.in; echo 'run 1'; } >data.in

# flip AT: bit AT % 8 of byte AT of the file bad
flip() {
    local byte
    byte=$(od -An -tu1 -j "$1" -N1 bad)
    # shellcheck disable=SC2059
    printf "$(printf '\\%03o' $((byte ^ (1 << ($1 % 8)))))" | dd of=bad bs=1 seek="$1" conv=notrunc status=none
}

# judge WHAT CODES WORDS...: one of these exit codes, and a message unless it is 0
judge() {
    local what=$1 codes=$2 code=0
    shift 2
    timeout -k 5 300 "$HALFSHELL" "$@" >out 2>err || code=$?
    case " $codes " in
    *" $code "*) ;;
    *) fail "$what: exit code $code: $(tail -3 err)" ;;
    esac
    [ "$code" -eq 0 ] || [ "$(grep -c 'error:' err)" -eq 1 ] || fail "$what: not one message: $(cat err)"
    count[code]=$((${count[code]:-0} + 1))
}

# study FILE FIRST CODES WORDS...: the program reads FILE under the name bad, one bit flipped, or cut, from byte FIRST on
study() {
    local file=$1 first=$2 codes=$3 size step at
    shift 3
    cp "$file" bad
    judge "$*: $file as it was written" 0 "$@"
    count=()
    size=$(stat -c %s "$file")
    step=$(((size - first + n_places - 1) / n_places))
    for ((at = first; at < size; at += step)); do
        cp "$file" bad
        flip "$at"
        judge "$*: $file with byte $at of $size flipped" "$codes" "$@"
        head -c "$at" "$file" >bad
        judge "$*: $file cut at byte $at of $size" "$codes" "$@"
    done
    echo "$file, $*: $(for k in "${!count[@]}"; do echo -n "${count[$k]} ended with exit code $k; "; done)"
}
study whole.chk 512 1 resume bad # before it is a remark for readers, which test_checkpoint.sh looks at
study whole.data 1 "0 1 2" data.in -log none
study whole.h5 1 "0 1 2" append.in -log none
study whole.h5 1 "0 1 2" rerun.in -log none
