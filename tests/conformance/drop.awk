# Judges a drop by three reports: the demo without, the demo with the soft body, the soft body.
FNR == 1 { ++report }
$1 == "body" && report == 1 { ++n; x[n] = $2; y[n] = $3; z[n] = $4 }
$1 == "body" && report == 2 {
    ++m
    d = sqrt(($2 - x[m])^2 + ($3 - y[m])^2 + ($4 - z[m])^2)
    if (d > moved)
        moved = d
    if ($0 ~ /nan|inf/)
        complain("rigid body " m " is nowhere")
}
$1 == "energy" { energy[report] = $2 }
report == 3 { soft[$1] = $2 }

function complain(what) {
    print row ": " what >"/dev/stderr"
    failed = 1
}

END {
    if (report != 3 || soft["steps"] == "" || n == 0 || n != m)
        complain("a report is missing or short")
    if (soft["finite"] != 1 || soft["stopped"] != 0)
        complain("the soft body went unstable")
    if (soft["contacts"] + 0 == 0)
        complain("it touched nothing")
    # A tenth of what stops it: it struck something, and did not merely brush it.
    if (soft["impulse"] < 0.1 * sqrt(2 * soft["mass"] * soft["brought"]))
        complain("contacts changed its momentum by " soft["impulse"] " N s only")
    if (moved + 0 < 1e-3)
        complain("it moved no rigid body: " moved + 0 " m")
    # 1 mPa is 34 dB SPL: leaves in a breeze.
    if (soft["peak"] + 0 < 1e-3)
        complain("it was not heard: " soft["peak"] " Pa")
    gained = soft["brought"] > 0 ? (energy[2] - energy[1]) / soft["brought"] : 0
    if (bounded == "yes" && !(gained <= 1))
        complain("the rigid bodies gained " gained " times the energy that it brought")
    # Rounding of the printed figures aside.
    if (bounded == "yes" && soft["gain"] > 1.001)
        complain("it became " soft["gain"] " times as fast as its fall explains")
    cost = soft["seconds"] > 0 ? soft["cpu"] / soft["seconds"] : 0
    printf "%s %d %.3g %.3g %.3g %.3g %.2g\n", row, soft["contacts"], soft["impulse"], moved,
        gained, soft["peak"], cost
    exit failed
}
