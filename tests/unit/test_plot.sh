#!/bin/bash
# halfshell plot: the picture has the axes and curves that were asked for; hostile names and texts stay text; what cannot be
# drawn is refused with a reason.
set -u
command -v gnuplot >/dev/null 2>&1 || exit 77
. "$PROJECT_ROOT/tests/support/folder.sh"
plot() { "$HALFSHELL" plot "$@" >out 2>err; }
# draws N PART COMMAND...: the SVG has N curves and the text.
draws() {
    local n=$1 part=$2
    shift 2
    plot "$@" -out picture.svg || { wrong "failed: $* ($(cat err))"; return; }
    [ "$(grep -c '<g id="gnuplot_plot_' picture.svg)" -eq "$n" ] || wrong "not $n curves: $*"
    grep -qF -- "$part" picture.svg || wrong "no '$part' in: $*"
}
refuses() {
    local part=$1
    shift
    if plot "$@"; then wrong "not refused: $*"; fi
    grep -qF -- "$part" err || wrong "no '$part' in: $(cat err)"
}

cat >deck.in <<'END'
units lj
lattice fcc 0.8
region b block 0 4 0 4 0 4
create_box 1 b
create_atoms 1 box
mass 1 1
velocity all create 1.0 4928459
pair_style lj/cut 2.5
pair_coeff 1 1 1 1
fix 1 all nve
timestep 0.002
thermo 5
run 20
run 20
END
"$HALFSHELL" deck.in -log log.a -screen none || exit 1
draws 4 'temperature (ε/k)' log.a
draws 4 'energy per atom (ε)' log.a
draws 4 'pressure (ε/σ³)' log.a
draws 1 '>step<' log.a -y Temp
draws 1 'time (τ)' log.a -y Temp -x time
draws 1 ' 0.08<' log.a -y Temp -x time # 40 steps of 0.002
draws 2 '>TotEng<' log.a -y '*Eng,E_pair'
draws 2 '>warm<' log.a log.a -y 2 -legend cold,warm -block last
printf 'units lj\nlattice fcc 0.8\nregion b block 0 3 0 3 0 3\ncreate_box 1 b\ncreate_atoms 1 box\nmass 1 1\nvelocity all create 1.0 4928459\npair_style lj/cut 2.5\npair_coeff 1 1 1 1\nfix 1 all nve\nthermo 5\nrun 20\nrun 10\nreset_timestep 0\nfix s all ave/spectrum 1 10 20 c_thermo_temp error yes file spectrum\nfix f all ave/isf 1 10 20 5.0 4 file isf\nfix m all ave/self 1 10 20 msd isf 7 file motion\nrun 20\n' >back.in
"$HALFSHELL" back.in -log log.back -screen none || exit 1
draws 2 'Temp, runs 1 to 2<' log.back -y Temp # steps were set back: two curves
draws 2 'frequency (1/τ)' spectrum -deck log.back # bars are a curve of their own
draws 2 'spectrum of c_thermo_temp' spectrum -deck log.back
draws 4 'intermediate scattering' isf -deck log.back -x time -y 'F(*'
draws 1 'mean-square displacement (σ²)' motion -deck log.back -y msd
draws 1 'temperature (K)' log.a -y Temp -units real
printf 'method,threads,rate,rate_err\ncluster,1,10,.5\ncluster,2,19,1\ncell,1,5,.3\ncell,2,9.7,.4\n' >scaling.csv
draws 4 '>cell<' scaling.csv -x threads # error bars are curves of their own
draws 2 '>cell<' scaling.csv -x threads -errors none -logscale xy
printf 'x,b,a,ea,eb\n1,2,3,.1,.2\n2,3,4,.1,.2\n' >order.csv
draws 4 '>a<' order.csv -y a,b -errors ea,eb
awk 'BEGIN { print "x,y"; for (i = 0; i < 200000; ++i) print i "," (i == 77777 ? 9 : sin(i)) }' >long.csv
draws 1 ' 10<' long.csv # the one peak is there, and the file small
[ "$(wc -c <picture.svg)" -lt 300000 ] || wrong "a long line makes a large file"
plot log.a && [ "$(head -c 4 log.a.png | tail -c 3)" = PNG ] || wrong "no log.a.png"
plot log.a -out a.pdf && [ "$(head -c 4 a.pdf)" = %PDF ] || wrong "no a.pdf"

# Names that a shell or gnuplot could take for commands.
evil="'; touch pwned; \`touch pwned\` \$(touch pwned) \"@x | touch pwned"
cp log.a "$evil"
draws 4 'touch pwned' "$evil" -title "$evil" -y Temp,Press,3,5
draws 2 'touch pwned' "$evil" log.a -y Temp -xlabel "it's
 a 'label'; system('touch pwned')" -ylabel '`touch pwned`'
plot log.a -out '|touch pwned;.svg' || wrong "a bar in the name of a picture"
[ -s '|touch pwned;.svg' ] || wrong "the picture is not where it should be"
[ ! -e pwned ] || wrong "a text was carried out"
printf "plot 'touch pwned'\n" >.gnuplot
HOME=$folder draws 1 '>step<' log.a -y Temp

refuses "no file given" -y Temp
refuses "'nothing' cannot be read: No such file" nothing
refuses "'.' is a folder" .
refuses "deck.in:2: error: 3 words under a line of 2: this is neither a log" deck.in
refuses "has no column 'Tmp'; did you mean 'Temp'?" log.a -y Tmp
refuses "has no run '7'; it has 1 to 2" log.a -block 7
refuses "should end in .png, .svg or .pdf" log.a -out a.jpeg
refuses "unknown option '-titel'; did you mean '-title'?" log.a -titel x
refuses "is not a range LO:HI" log.a -xrange 5
refuses "only values above zero" log.a -y E_pair -logscale y
printf '# x\n# TimeStep a\n0 1\n10 2\n' >series
refuses "the timestep is not known" series -x time
refuses "has no column 'time'; its columns are: method threads" scaling.csv -x time
for tool in grep cat; do ln -s "$(command -v $tool)" $tool; done
PATH=$folder refuses "gnuplot, which draws the plots, is not on the PATH" log.a
[ "$n_wrong" -eq 0 ]
