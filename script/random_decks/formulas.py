"""Variables of a random deck, and formulas of all kinds."""
from random_decks.system import live_region

FORMULAS = ["pe/atoms+ke", "sqrt(temp)*exp(-step/50)", "ramp(0,5)", "step%7+vol^(1/3)", "bound(all,xmax)-bound(all,xmin)",
            "xcm(all,x)", "vcm(all,y)", "ke(all)", "gyration(all)", "mass(all)", "count(all)", "fcm(all,x)", "(step>10)*temp||0",
            "stagger(20,5)", "swiggle(1,2,10)", "vdisplace(1,0.1)", "cwiggle(1,2,10)", "torque(all,z)", "angmom(all,z)",
            "inertia(all,xx)", "omega(all,z)", "floor(vol*0.37)+ceil(pe)+round(ke)", "sin(step)+cos(step)*tan(0.1)+atan2(1,2)",
            "random(0,1,55)*0+ln(2)+log(10)", "logfreq(10,3,10)", "logfreq2(10,3,10)", "logfreq3(2,10,100)", "stride(5,60,7)",
            "stride2(1,50,5,20,30,2)", "normal(0,1,99)*0+abs(-2)", "x[5]+vy[7]", "fx[10]", "-2^2+2^-1", "!(step>3)&&1", "1<=2==1",
            "dt*elapsed+time*0", "(step<=7)|^(temp>0.1)", "asin(0.3)+acos(0.2)+atan(step)", "PI*lx", "random(2,9,55)", "normal(1,0.5,99)+random(0,1,7)",
            "type[3]+mass[3]", "id[4]", "elapsed%3==0", "is_defined(compute,thermo_temp)+is_available(pair,lj/cut)", "yes+no+true+false", "1.5e2-3E-1",
            "v_nest*2", "c_thermo_press[2]+c_thermo_temp", "c_thermo_temp[1]", "2^3^2", "10-3-2", "100/5/2", "7%4%2", "-(3)+-2*-2", "!0+!1", "1!=2", "3>=3",
            "evdwl+ecoul+elong+emol+ebond+eangle+edihed+eimp", "density*vol", "xhi-xlo+cella", "enthalpy-pe", "part+nbuild*0+cellalpha", "elaplong",
            "version", "bonds+angles+impropers+dihedrals", "xlat+ylat", "tpcpu*0+cpu*0+spcpu*0+cpuremain*0"]
GROUP_FORMULAS = ["count({g})", "mass({g})", "xcm({g},y)", "vcm({g},x)", "fcm({g},y)", "bound({g},ymin)", "gyration({g})", "ke({g})",
                  "angmom({g},z)", "torque({g},z)", "inertia({g},zz)", "omega({g},z)", "count(all,{r})", "mass({g},{r})",
                  "ke({g},{r})", "xcm({g},x,{r})", "vcm({g},y,{r})", "bound({g},xmax,{r})", "fcm({g},x,{r})", "gyration({g},{r})",
                  "angmom({g},x,{r})", "torque({g},y,{r})", "inertia({g},xy,{r})", "omega({g},z,{r})"]
TERMS = ["step", "temp", "pe", "ke", "vol", "2", "0.5", "atoms", "lx", "pxx", "press", "elapsed", "dt", "etotal"]


def random_formula(deck, depth=3):
    """A formula of random operators over numbers that are never 0 or large."""
    if depth == 0 or deck.chance(0.2):
        return deck.random.choice(TERMS)
    one, two = random_formula(deck, depth - 1), random_formula(deck, depth - 1)
    return deck.pick(f"{one}+{two}", f"({one}-{two})", f"{one}*{two}", f"{one}/(1+abs({two}))", f"sqrt(abs({one}))", f"-{one}", f"({one}<{two})",
                     f"({one}>{two})*{one}", f"cos({one})", f"ln(1+abs({two}))", f"(abs({one})+1)^0.3", f"floor({one})%7", f"({one}>=1)&&({two}<1)",
                     f"({one}==1)||({two}!=2)", f"!({one})", f"exp(-abs({one}))", f"atan2({one},1+abs({two}))", f"round({one})")


def atom_formula(deck, value="vx"):
    """A formula with a value for each atom."""
    r, g = None, deck.group()
    formula = deck.pick("x*x+vy", "abs(fx)", f"{value}+1", "mass*vx^2", "(id<100)*y", "type*fy", f"sqrt({value}*{value})", f"({value}>0.5)*vy", "ln(1+x*x)-z",
                        "rmask({r})*vx", f"gmask({g})+id%5", f"grmask({g},{{r}})*type", "x[3]-x", "(vx>0)&&(vy<0)||(type==2)", "floor(x)+round(y)%3",
                        "ramp(0,1)*x", "(id==5)|^(vx<0)", "temp*vx", "-x^2", "!(vx>0)", "atan2(y,x)", "cwiggle(0,1,10)*vy", "cos(x)*exp(-y)",
                        "xcm(all,x)-x", "(x>=2)*1.0")
    if "{r}" in formula:
        r = live_region(deck)
        formula = formula.replace("{r}", r)
    return formula


def add_variables(deck):
    for _ in range(deck.pick(0, 0, 1, 2, 3)):
        add_variable(deck)


def add_variable(deck):
    name = deck.name("v")
    formula = random_formula(deck) if deck.chance(0.25) else deck.random.choice(FORMULAS + GROUP_FORMULAS)
    if "{r}" in formula:
        formula = formula.replace("{r}", live_region(deck))
    if "v_nest" in formula:
        deck.add('variable nest equal "temp^2+1"')
    deck.add(f'variable {name} equal "{formula.replace("{g}", deck.group())}"')
    deck.columns.append(f"v_{name}")
