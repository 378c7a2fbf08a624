# OrdinaryDiffEq: Vern9 and the symplectic tables, where Julia is installed.
#
# Compilation is not timed: each run is made once before. Rows as in `peer.py`.

using JSON, OrdinaryDiffEq, Statistics, Pkg

const RUNS = 5
const SECONDS = 0.05
version_of(name) = string(first(p.version for p in values(Pkg.dependencies()) if p.name == name))

function cpu_seconds(run)
    times = map(1:RUNS) do _
        count, began = 0, time_ns()
        while true
            run()
            count += 1
            taken = 1e-9 * (time_ns() - began)
            taken >= SECONDS && return taken / count
        end
    end
    median(times)
end

function fields(problem)
    name, pars = problem["problem"], problem["parameters"]
    if name in ("kepler", "encounter")
        (dz, z, _, _) -> begin
            r3 = (z[1]^2 + z[2]^2)^1.5
            dz[1], dz[2], dz[3], dz[4] = z[3], z[4], -z[1] / r3, -z[2] / r3
        end
    elseif name == "henon_heiles"
        (dz, z, _, _) -> begin
            x, y, u, v = z
            dz[1], dz[2], dz[3], dz[4] = u, v, -x - 2x * y, -y - x^2 + y^2
        end
    elseif name == "pendulum"
        (dz, z, _, _) -> (dz[1] = z[2]; dz[2] = -sin(z[1]))
    elseif name == "coupled"
        (dz, z, _, _) -> (dz[1] = (z[1]^2 + 1) * z[2]; dz[2] = -z[1] * (z[2]^2 + 1))
    elseif name == "black_hole"
        E, L = pars["E"][1], pars["L"][1]
        (dz, z, _, _) -> begin
            r, theta, u, v = z
            s, c = sincos(theta)
            dz[1], dz[2] = (1 - 2 / r) * u, v / r^2
            dz[3] = -((u / r)^2 - v^2 / r^3 + E^2 / (r - 2)^2 - L^2 / (r^3 * s^2))
            dz[4] = L^2 * c / (r^2 * s^3)
        end
    end
end

for text in eachline(ENV["PROBLEMS"])
    problem = JSON.parse(text)
    (isempty(ARGS) || problem["problem"] in ARGS) || continue
    field = fields(problem)
    field === nothing && continue
    low = get(problem, "reference_low", zeros(length(problem["reference"])))
    exact = big.(Float64.(problem["reference"])) .+ big.(Float64.(low))
    start = Float64.(problem["start"])
    for tolerance in (1e-6, 1e-9, 1e-12, 1e-14)
        ode = ODEProblem(field, start, (0.0, Float64(problem["end"])))
        run() = solve(ode, Vern9(); abstol = tolerance, reltol = tolerance, save_everystep = false, maxiters = 10^9)
        row = Dict{String,Any}("problem" => problem["problem"], "peer" => "Julia",
            "version" => version_of("OrdinaryDiffEq"), "method" => "Vern9", "setting" => "tol $tolerance")
        try
            row["error"] = Float64(maximum(abs.(big.(run().u[end]) .- exact)))
            row["seconds"] = cpu_seconds(run)
        catch reason
            row["failed"] = sprint(showerror, reason)
        end
        println(JSON.json(row))
    end
end
