# bash completion for halfshell
_halfshell() {
    local commands="run resume check bench plot report help"
    local options_run=" -in -var -log -walltime -screen -echo -threads -neigh -precision -reproducible -isa -suffix -package --help --version"
    local options_resume=" -log -walltime -threads -neigh -precision -reproducible -isa"
    local options_check=" -in -var -threads -neigh -precision -reproducible -isa -ranks -speed -latency -bandwidth -suffix -package"
    local options_bench=" -precision -reproducible -isa -size -steps -repeat -threads -ranks -neigh -only -out"
    local options_plot=" -out -x -y -errors -block -deck -units -logscale -xrange -yrange -style -title -legend -xlabel -ylabel -size"
    local options_report=" -out"
    local options_help=""
    local methods=" auto cell cluster hash incremental linked nsq verlet"
    local topics="command-line exit-codes commands angle_style atom_modify atom_style balance bond_style boundary box change_box checkpoint clear comm_modify comm_style compute compute_modify create_atoms create_box delete_atoms dihedral_style dimension displace_atoms dump dump_modify echo fix fix_modify group if improper_style include info jump kspace_style label lattice log mass min_modify min_style minimize neigh_modify neighbor neighbor_method newton next package pair_coeff pair_modify pair_style pair_write precision print processors quit read_data read_dump read_restart region replicate reproducible rerun reset_atom_ids reset_timestep restart run run_style set shell special_bonds suffix thermo thermo_modify thermo_style timer timestep uncompute undump unfix units variable velocity write_coeff write_data write_dump write_restart pair born buck colloid cosine/squared gauss gauss/cut harmonic/cut harmonic/repulsion harmonic/sphere hybrid hybrid/overlay lj/class2 lj/cubic lj/cut lj/expand lj/sf lj/smooth lj/smooth/linear lj96/cut mie/cut morse nm/cut none soft table wca yukawa zero fix adapt addforce atom/swap ave/atom ave/chunk ave/correlate ave/correlate/fft ave/correlate/long ave/histo ave/histo/weight ave/isf ave/self ave/spectrum ave/time aveforce balance box/relax brownian brownian/sphere controller deform deposit drag dt/reset ehex enforce2d evaporate flow/gauss gcmc gravity group/dynamic halt heat indent langevin lineforce momentum move nph nph/sphere npt npt/sphere numdiff nve nve/limit nve/noforce nve/sphere nvt nvt/sllod nvt/sphere oneway planeforce press/berendsen print propel/self property/atom recenter rhok setforce spring spring/rg spring/self store/state temp/berendsen temp/csvr temp/rescale thermal/conductivity vector viscosity viscous wall/harmonic wall/lj1043 wall/lj126 wall/lj93 wall/reflect wall/reflect/stochastic wall/region widom compute angmom/chunk centro/atom chunk/atom chunk/spread/atom cluster/atom cna/atom com com/chunk coord/atom dipole dipole/chunk displace/atom erotate/sphere global/atom group/group gyration gyration/chunk gyration/shape heat/flux hexorder/atom inertia/chunk ke ke/atom momentum msd msd/chunk msd/nongauss omega/chunk orientorder/atom pair pair/local pe pe/atom pressure property/atom property/chunk property/local rdf reduce reduce/chunk reduce/region slice sq stress/atom temp temp/chunk temp/com temp/deform temp/partial temp/profile temp/ramp temp/region temp/sphere torque/chunk vacf vcm/chunk region block cone cylinder intersect plane prism sphere union dump atom cfg custom dcd extxyz h5md image local xyz thermo angles atoms bonds cella cellalpha cellb cellbeta cellc cellgamma cpu cpuremain density dihedrals dt eangle ebond econserve ecoul ecouple edihed eimp elaplong elapsed elong emol enthalpy epair etail etotal evdwl fmax fnorm impropers ke lx ly lz nbuild ndanger part pe press pxx pxy pxz pyy pyz pzz spcpu step temp time timeremain tpcpu vol xhi xlat xlo xy xz yhi ylat ylo yz zhi zlat zlo neighbor auto cell cluster hash incremental linked nsq verlet"
    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} command=run offered= is_file=yes
    case " $commands " in *" ${COMP_WORDS[1]} "*) [ "$COMP_CWORD" -gt 1 ] && command=${COMP_WORDS[1]} ;; esac
    case $before in
    -echo | -e) is_file= offered="none screen log both" ;;
    -neigh) is_file= offered="$methods" ;;
    -precision) is_file= offered="double mixed" ;;
    -reproducible) is_file= offered="on off" ;;
    -isa) is_file= offered="auto portable sse2 avx2 avx512" ;;
    -logscale) is_file= offered="x y xy none" ;;
    -style) is_file= offered="lines points both" ;;
    *)
        case $command in
        help) is_file= offered=$topics ;;
        *) offered=options_$command offered=${!offered} ;;
        esac
        [ "$COMP_CWORD" -eq 1 ] && offered="$offered $commands"
        ;;
    esac
    COMPREPLY=($(compgen -W "$offered" -- "$word"))
    local IFS=$'\n'
    [ -z "$is_file" ] || COMPREPLY+=($(compgen -f -- "$word"))
}
complete -o filenames -F _halfshell halfshell
