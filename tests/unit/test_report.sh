#!/bin/bash
# halfshell report: one page with all there is, which asks no other host for anything and carries out nothing.
set -u
command -v gnuplot >/dev/null 2>&1 || exit 77
. "$PROJECT_ROOT/tests/support/folder.sh"
has() { grep -qF -- "$1" "${2:-page.html}" || wrong "the page has no: $1"; }
has_not() { ! grep -qF -- "$1" page.html || wrong "the page has: $1"; }

mkdir run
cd run || exit 1
cat >in.fluid <<'END'
# a fluid
units lj
variable n index 4
lattice fcc 0.8
region b block 0 $n 0 4 0 4
create_box 1 b
create_atoms 1 box
mass 1 1
velocity all create 1.0 4928459
pair_style lj/cut 2.5
pair_coeff 1 1 1 1
fix 1 all nve
dump d all image 20 atoms.*.png type type size 60 60
thermo 1
print "</pre><script>alert(1)</script> & 'quotes'"
run 40
END
"$HALFSHELL" in.fluid -screen none || exit 1
printf '# Chunk-averaged <b>data</b> for fix c\n# Timestep Number-of-chunks Total-count\n# Chunk Coord1 vx\n5 2 3\n1 0.5 1\n2 1 2\n' >profile.dat
printf 'not a table at all\n' >notes.txt
cp profile.dat "<img src=x>.dat"
cd .. || exit 1

"$HALFSHELL" report run -out page.html >out 2>err || wrong "no report: $(cat err)"
[ ! -s err ] || wrong "standard error: $(cat err)"
has "page.html: 3 figures" out
[ "$(grep -c '<svg' page.html)" -eq 3 ] || wrong "not three plots"
[ "$(grep -o 'src="data:image/png;base64,' page.html | wc -l)" -eq 3 ] || wrong "not three snapshots"
has "temperature (ε/k)"
has '<th scope="row">TotEng</th>'
has "steps 0 to 40, 41 rows"
has "region b block 0 \$n 0 4 0 4"
has "<title>run</title>"
has "Running on "
# The deck's lines as they were written, without what substitution made of them.
sed -n '/<h2>Deck/,/<\/pre>/p' page.html >deck
grep -qF 'block 0 4 0 4' deck && wrong "a substituted line in the deck"
grep -qF 'create_atoms CPU' deck && wrong "output in the deck"
# Nothing that makes a browser ask: no address, no script, no element or attribute from the data.
has_not "://"
has_not "<script"
has_not "<img src=x"
has_not "<b>data"
has "&lt;script&gt;"
has "&lt;b&gt;data&lt;/b&gt;"
[ "$(grep -oE "(src|href)=[\"'][^\"']*" page.html | grep -vcE "=[\"'](data:|#)")" -eq 0 ] || wrong "an address that is not data"
# An id may stand in a page once.
[ -z "$(grep -oE " id=[\"'][^\"']*" page.html | sort | uniq -d)" ] || wrong "an id stands twice"

"$HALFSHELL" report run/log.halfshell >out 2>err || wrong "no report of a log: $(cat err)"
[ "$(grep -c '<svg' log.halfshell.html)" -eq 1 ] || wrong "not one plot of a log"

refuses() {
    local part=$1
    shift
    if "$HALFSHELL" report "$@" >out 2>err; then wrong "not refused: $*"; fi
    grep -qF -- "$part" err || wrong "no '$part' in: $(cat err)"
}
mkdir empty
refuses "no run given"
refuses "'nothing' cannot be read: No such file" nothing
refuses "'empty' holds nothing to report" empty
refuses "'run/notes.txt' holds no rows of numbers" run/notes.txt
refuses "'run' and 'empty' are two runs" run empty
[ ! -e nothing.html ] && [ ! -e empty.html ] || wrong "a page of nothing"

# Without gnuplot the page tells so in place of the plots, and on the terminal.
mkdir bin
PATH=$folder/bin "$HALFSHELL" report run -out plain.html >out 2>err || wrong "no report without gnuplot: $(cat err)"
has "the page lacks plots: gnuplot, which draws the plots, is not on the PATH" err
has "apt-get install gnuplot-nox" plain.html
has '<th scope="row">TotEng</th>' plain.html
printf '#!/bin/sh\nexit 3\n' >bin/gnuplot
chmod +x bin/gnuplot
PATH=$folder/bin "$HALFSHELL" report run -out plain.html >out 2>err || wrong "no report with a broken gnuplot: $(cat err)"
has "the page lacks plots: gnuplot ended with exit code 3" err

# A browser, where there is one, finds the same, and the page makes it ask no other host. What the browser asks its maker for
# on its own account does not count.
if command -v chromium >/dev/null 2>&1; then
    timeout 60 chromium --headless=new --no-sandbox --disable-gpu --disable-background-networking --disable-component-update \
        --disable-sync --no-first-run --user-data-dir="$folder/profile" --log-net-log="$folder/net.json" --dump-dom \
        "file://$folder/page.html" >dom 2>/dev/null && {
        [ "$(grep -o '<svg' dom | wc -l)" -eq 3 ] || wrong "the browser has not three plots"
        [ "$(grep -o '<path\|<polyline' dom | wc -l)" -ge 20 ] || wrong "the browser's plots are empty"
        [ "$(grep -o '<tr>' dom | wc -l)" -ge 6 ] || wrong "the browser has no table"
        asked=$(grep -oE '"url":"(https?|wss?|ftp)://[^"]*"' net.json | grep -vE '://([a-z0-9.-]+\.)?(google|googleapis|gstatic)\.com/')
        [ -z "$asked" ] || wrong "the page asks for: $asked"
    }
fi
[ "$n_wrong" -eq 0 ]
