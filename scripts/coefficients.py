#!/usr/bin/env python3
"""The coefficient tables of the schemes, polished on their order conditions.

Input: the digits as published (`TABLES` below, with their sources). Output: the Rust constants in
`hamiltonian-core/src/schemes/tables/`, each a list of `Weight(hi, lo)`, to standard output; with a
table's name as argument, that one alone. Needs mpmath.

A published table is a point near the solutions of its order conditions. As many of its numbers as
the conditions leave free are taken as printed; the others are solved for by Newton's method. Which
ones are free is found by elimination with complete pivoting of the Jacobian, whose rank is the
number of independent conditions. Then all conditions, the dependent ones too, must hold to 1e-50.

The conditions of each class:

* general: a one-step map and its adjoint, or two exact flows that compose. The map is written
  exp(hY1 + h²Y2 + …), its adjoint exp(hY1 − h²Y2 + …), products are expanded in words over the
  letters 1, 2, 3, … of weight 1, 2, 3, …; a word of weight n ≤ order must have the coefficient that
  it has in exp(hY1). For compositions of a symmetric map there are odd letters only.
* Nyström: kicks and drifts of q̈ = f(q), by the trees of Nyström methods (Hairer, Nørsett, Wanner,
  Solving Ordinary Differential Equations I, 1993, section II.14).
* near-integrable: H = A + εB; a word with k letters B must have the coefficient of exp(h(A + B)) up
  to the length r_k; then the error is O(ε h^r1 + ε² h^r2 + …) (McLachlan, BIT 35, 258, 1995).
"""

import sys
from functools import lru_cache

from mpmath import cbrt, fabs, factorial, matrix, mp, mpf, sinh, sqrt, taylor

mp.dps = 60
SLACK = mpf(10) ** -50


# --- order conditions ----------------------------------------------------------------------------

@lru_cache(maxsize=None)
def words(letters, order):
    """All words over `letters`, a letter being its weight, of weight at most `order`."""
    found, last = [()], [()]
    while last:
        last = [w + (k,) for w in last for k in letters if sum(w) + k <= order]
        found += last
    return sorted(found, key=sum)


def times_exponential(series, letter, space):
    """series · exp(Σ letter(k)·k), on the words of `space`."""
    product = {}
    for word in space:
        total, tail = series[word], mpf(1)
        for m in range(1, len(word) + 1):
            tail *= letter(word[-m]) / m
            total += series[word[:-m]] * tail
        product[word] = total
    return product


def defects(factors, letters, order, target):
    """Coefficients of the product of exponentials less those of exp(target)."""
    space = words(letters, order)
    unit = {w: mpf(w == ()) for w in space}
    series = unit
    for letter in factors:
        series = times_exponential(series, letter, space)
    exact = times_exponential(unit, target, space)
    return [series[w] - exact[w] for w in space]


def general(table, x, order):
    first = lambda k: mpf(k == 1)
    if table.is_symmetric_composition():
        odd = tuple(range(1, order + 1, 2))
        return defects([lambda k, g=g: g**k for g in table.full(x)], odd, order, first)
    pairs = table.zigzag(x)
    factors = []
    for down, up in pairs:
        factors.append(lambda k, d=down: d**k)
        factors.append(lambda k, u=up: -((-u) ** k))
    return defects(factors, tuple(range(1, order + 1)), order, first)


@lru_cache(maxsize=None)
def trees(size):
    """Trees of f with `size` = exponent of h in the root's argument: (velocities, subtrees)."""
    found = []

    def choose(left, largest, chosen):
        found.append((left, tuple(chosen)))
        for n in range(min(left - 2, largest), -1, -1):
            for sub in trees(n):
                if not chosen or (n, sub) <= chosen[-1]:
                    choose(left - 2 - n, n, chosen + [(n, sub)])

    choose(size, size, [])
    return found


def nystrom(table, x, order):
    """q̈ = f(q): elementary weights of kicks b_i at the times c_i."""
    times, kicks, now = [], [], mpf(0)
    drift = table.first == "drift"
    for weight in table.strokes(x):
        if drift:
            now += weight
        else:
            times.append(now)
            kicks.append(weight)
        drift = not drift
    stages = range(len(kicks))

    @lru_cache(maxsize=None)
    def stage(tree):
        """The tree's value at each kick, and the constant C of its exact value C·s^size."""
        velocities, subtrees = tree
        values, exact = [c**velocities for c in times], mpf(1)
        for size, sub in subtrees:
            inner, constant = stage(sub)
            for i in stages:
                values[i] *= sum((kicks[l] * (times[i] - times[l]) * inner[l] for l in range(i)), mpf(0))
            exact *= constant / ((size + 1) * (size + 2))
        return values, exact

    conditions = [now - 1]
    for size in range(order):
        for tree in trees(size):
            values, exact = stage(tree)
            conditions.append(sum(b * v for b, v in zip(kicks, values)) - exact / (size + 1))
            if size + 2 <= order:
                end = sum(b * (1 - c) * v for b, c, v in zip(kicks, times, values))
                conditions.append(end - exact / ((size + 1) * (size + 2)))
    return conditions


def near_integrable(table, x, orders):
    """Words over A and B, as long as the number of their letters B asks for."""
    longest = orders[0]
    space, layer = [()], [()]
    limit = lambda bs: longest if bs == 0 else orders[min(bs, len(orders)) - 1]
    for _ in range(longest):
        layer = [w + (k,) for w in layer for k in "AB" if limit((w + (k,)).count("B")) > len(w)]
        space += layer
    unit = {w: mpf(w == ()) for w in space}
    series, a = unit, True
    for weight in table.strokes(x):
        letter = "A" if a else "B"
        series = times_exponential(series, lambda k, l=letter, c=weight: c if k == l else mpf(0), space)
        a = not a
    exact = times_exponential(unit, lambda k: mpf(1), space)
    return [series[w] - exact[w] for w in space]


# --- layouts -------------------------------------------------------------------------------------

class Table:
    """`numbers` as published, in the layout:

    * symmetric: γ₁ … γ of the middle, of a composition of a symmetric map, then mirrored;
    * chi: α₁ … αₙ, mirrored, of χ and its adjoint in turn;
    * strokes: c₁ d₁ c₂ …, the weights of the two pieces in turn, mirrored if `mirror`.

    `complete` adds the number that the source gives as one less the others.
    """

    def __init__(self, name, kind, order, layout, numbers, *, first="", mirror=True, complete=False):
        self.name, self.kind, self.order, self.layout = name, kind, order, layout
        self.first, self.mirror = first, mirror
        self.digits = [mpf(n) for n in numbers]
        if complete:
            self.digits.append(1 - 2 * sum(self.digits))

    def is_symmetric_composition(self):
        return self.layout == "symmetric"

    def full(self, x):
        if self.layout == "chi":
            return x + x[::-1]
        return x + x[-2::-1] if self.mirror else x

    def strokes(self, x):
        """Weights of the first and the second piece in turn."""
        if self.layout == "strokes":
            return self.full(x)
        chi = [c for pair in self.zigzag(x) for c in pair]
        return [chi[0]] + [a + b for a, b in zip(chi, chi[1:])] + [chi[-1]]

    def zigzag(self, x):
        if self.layout == "strokes":
            flat, previous = [], mpf(0)
            for weight in self.full(x):
                previous = weight - previous
                flat.append(previous)
            if len(flat) % 2:
                flat.pop()
        elif self.layout == "symmetric":
            flat = [g / 2 for g in self.full(x) for _ in "du"]
        else:
            flat = self.full(x)
        return list(zip(flat[::2], flat[1::2]))

    def conditions(self, x):
        check = {"general": general, "nystrom": nystrom, "near-integrable": near_integrable}
        return check[self.kind](self, list(x), self.order)


class Processed(Table):
    """`kernel` as a table; `processor` the durations d₁ u₁ d₂ u₂ … of its stages, but for the last, which
    makes their sum zero. `layout` "twice" adds the same stages with −h, which makes most odd terms vanish;
    "symmetric" does it with steps γ₁h, γ₂h, … of a symmetric map. With `fixed` the kernel is not moved.
    """

    def __init__(self, name, kind, order, kernel, processor, *, layout="strokes", fixed=False):
        self.name, self.kind, self.order = name, kind, order
        self.kernel, self.processor_layout, self.fixed = kernel, layout, fixed
        self.layout, self.first = "processed", kernel.first
        self.digits = ([] if fixed else kernel.digits) + [mpf(n) for n in processor]

    def parts(self, x):
        """The numbers of the kernel and the durations of the processor, in turn down and up."""
        count = 0 if self.fixed else len(self.kernel.digits)
        kernel, processor = (self.kernel.digits if self.fixed else x[:count]), x[count:]
        return kernel, processor + [-sum(processor)]

    def is_symmetric_composition(self):
        return self.kernel.layout == "symmetric" and self.processor_layout == "symmetric"

    def chi(self, x):
        """π⁻¹, K, π as durations, in turn down and up."""
        kernel, processor = self.parts(x)
        if self.processor_layout == "symmetric":
            processor = [g / 2 for g in processor for _ in "du"]
        if self.processor_layout != "strokes":
            processor = processor + [-c for c in processor]
        flat = [c for pair in self.kernel.zigzag(kernel) for c in pair]
        return [-c for c in processor[::-1]] + flat + processor

    def full(self, x):
        return [2 * c for c in self.chi(x)[::2]]

    def zigzag(self, x):
        flat = self.chi(x)
        return list(zip(flat[::2], flat[1::2]))

    def strokes(self, x):
        chi = self.chi(x)
        return [chi[0]] + [a + b for a, b in zip(chi, chi[1:])] + [chi[-1]]

    def rust(self, x):
        kernel, processor = self.parts(list(x))
        return f"{rust(self.kernel, kernel)}\n{self.name}: {weights(processor)}"


class Mean(Table):
    """The cheap post-processor ρ of the table `processed`: the mean of ρ(h) and ρ(−h) agrees with π in the words
    of weight at most `to`, both being even. ρ is χ and its adjoint in turn, and the sum of its durations is zero.
    """

    def __init__(self, name, processed, to, numbers):
        self.name, self.processed, self.to = name, processed, to
        self.digits = [mpf(n) for n in numbers]

    @lru_cache(maxsize=None)
    def wanted(self):
        _, processor = self.processed.parts(polish(self.processed))
        return self.series(processor + [-c for c in processor])

    def series(self, numbers):
        """The words of a composition for which there are conditions."""
        space = words(tuple(range(1, self.to + 1)), self.to)
        series = {w: mpf(w == ()) for w in space}
        for i, c in enumerate(numbers):
            sign = (-1) ** i
            series = times_exponential(series, lambda k, c=c, s=sign: s * (s * c) ** k, space)
        return [series[w] for w in space if sum(w) % 2 == 0 or w == (1,)]

    def conditions(self, x):
        return [a - b for a, b in zip(self.series(list(x)), self.wanted())]

    def rust(self, x):
        return f"{self.name}: {weights(x)}"


# --- polishing -----------------------------------------------------------------------------------

def jacobian(table, x):
    step = mpf(10) ** -(mp.dps // 3)
    columns = []
    for j in range(len(x)):
        up, down = list(x), list(x)
        up[j] += step
        down[j] -= step
        columns.append([(a - b) / (2 * step) for a, b in zip(table.conditions(up), table.conditions(down))])
    return [[column[i] for column in columns] for i in range(len(columns[0]))]


def pivots(rows):
    """Independent rows and columns, by elimination with complete pivoting."""
    rows = [list(r) for r in rows]
    chosen = []
    scale = max(fabs(v) for r in rows for v in r)
    while True:
        free = [i for i in range(len(rows)) if i not in [c[0] for c in chosen]]
        if not free:
            break
        value, i, j = max((fabs(rows[i][j]), i, j) for i in free for j in range(len(rows[0])))
        if value < scale * mpf(10) ** -8:
            break
        chosen.append((i, j))
        for k in free:
            if k != i:
                factor = rows[k][j] / rows[i][j]
                rows[k] = [a - factor * b for a, b in zip(rows[k], rows[i])]
                rows[k][j] = mpf(0)
    return [c[0] for c in chosen], [c[1] for c in chosen]


def polish(table):
    x = list(table.digits)
    with_digits = max(fabs(r) for r in table.conditions(x))
    slopes = jacobian(table, x)
    equations, solved = pivots(slopes)
    for _ in range(6):
        residual = table.conditions(x)
        if max(fabs(r) for r in residual) < SLACK:
            break
        slopes = jacobian(table, x)
        square = matrix([[slopes[i][j] for j in solved] for i in equations])
        change = mp.lu_solve(square, matrix([residual[i] for i in equations]))
        for j, d in zip(solved, change):
            x[j] -= d
    worst = max(fabs(r) for r in table.conditions(x))
    moved = max(fabs(a - b) for a, b in zip(x, table.digits))
    note = (f"{table.name}: {len(equations)} conditions, {len(x) - len(solved)} free of {len(x)}, "
            f"defect {mp.nstr(with_digits, 2)} -> {mp.nstr(worst, 2)}, moved by {mp.nstr(moved, 2)}")
    print(note, file=sys.stderr)
    if worst > SLACK:
        sys.exit(f"{table.name}: does not satisfy the conditions of its class")
    return x


# --- output --------------------------------------------------------------------------------------

def words_of(value):
    """The two f64 whose sum is nearest to `value`."""
    high = float(value)
    return high, float(value - mpf(high))


def weights(numbers):
    return "[" + ", ".join("Weight({!r}, {!r})".format(*words_of(number)) for number in numbers) + "]"


def rust(table, x):
    if isinstance(table, (Processed, Mean)):
        return table.rust(x)
    return f"{table.name}: {weights(x)}"


# --- the tables as published ---------------------------------------------------------------------

third = mpf(1) / 3
TABLES = [
    Table("RUTH_3", "general", 3, "strokes",
          [mpf(7) / 24, 2 * third, mpf(3) / 4, -2 * third, -mpf(1) / 24, 1],
          first="kick", mirror=False),
    Table("YOSHIDA_4", "general", 4, "symmetric",
          [1 / (2 - cbrt(2)), -cbrt(2) / (2 - cbrt(2))]),
    Table("SUZUKI_4", "general", 4, "symmetric",
          [1 / (4 - cbrt(4)), 1 / (4 - cbrt(4)), 1 - 4 / (4 - cbrt(4))]),
    Table("BLANES_MOAN_4", "general", 4, "chi",
          "0.0792036964311957 0.1303114101821663 0.2228614958676077 -0.3667132690474257 "
          "0.3246481886897062 0.1096884778767498".split()),
    Table("BLANES_MOAN_6", "general", 6, "chi",
          "0.050262764400392 0.098553683500650 0.314960616927694 -0.447346482695478 "
          "0.492426372489876 -0.425118767797691 0.237063913978122 0.195602488600053 "
          "0.346358189850727 -0.362762779254345".split()),
    Table("YOSHIDA_6", "general", 6, "symmetric",
          "0.78451361047755726381949763 0.23557321335935813368479318 "
          "-1.17767998417887100694641568".split(), complete=True),
    Table("KAHAN_LI_6", "general", 6, "symmetric",
          "0.39216144400731413927925056 0.33259913678935943859974864 -0.70624617255763935980996482 "
          "0.08221359629355080023149045 0.79854399093482996339895035".split()),
    Table("MCLACHLAN_8", "general", 8, "symmetric",
          "0.74167036435061295344822780 -0.40910082580003159399730010 0.19075471029623837995387626 "
          "-0.57386247111608226665638773 0.29906418130365592384446354 0.33462491824529818378495798 "
          "0.31529309239676659663205666 -0.79688793935291635401978884".split()),
    Table("KAHAN_LI_8", "general", 8, "symmetric",
          "0.13020248308889008087881763 0.56116298177510838456196441 -0.38947496264484728640807860 "
          "0.15884190655515560089621075 -0.39590389413323757733623154 0.18453964097831570709183254 "
          "0.25837438768632204729397911 0.29501172360931029887096624 "
          "-0.60550853383003451169892108".split()),
    Table("SOFRONIOU_SPALETTA_8", "general", 8, "symmetric",
          "0.10647728984550031823931967854896 0.10837408645835726397433410591546 "
          "0.35337821052654342419534541324080 -0.23341414023165082198780281128319 "
          "-0.24445266791528841269462171413216 0.11317848435755633314700952515599 "
          "0.11892905625000350062692972283951 0.12603912321825988140305670268365 "
          "0.12581718736176041804392391641587 0.11699135019217642180722881433533".split(),
          complete=True),
    Table("SOFRONIOU_SPALETTA_10", "general", 10, "symmetric",
          "0.07879572252168641926390768 0.31309610341510852776481247 0.02791838323507806610952027 "
          "-0.22959284159390709415121340 0.13096206107716486317465686 -0.26973340565451071434460973 "
          "0.07497334315589143566613711 0.11199342399981020488957508 0.36613344954622675119314812 "
          "-0.39910563013603589787862981 0.10308739852747107731580277 0.41143087395589023782070412 "
          "-0.00486636058313526176219566 -0.39203335370863990644808194 0.05194250296244964703718290 "
          "0.05066509075992449633587434 0.04967437063972987905456880".split(), complete=True),
    Table("SRKN_6B", "nystrom", 4, "chi",
          "0.082984406417405 0.162314550766866 0.233995250731502 0.370877414979578 "
          "-0.409933719901926 0.059762097006575".split(), first="kick"),
    Table("SRKN_11B", "nystrom", 6, "chi",
          "0.041464998518262 0.081764777428009 0.116363894490058 0.174189903309500 "
          "-0.214196095413653 0.087146882788236 -0.011892898486655 -0.234438862575420 "
          "0.222927475154732 0.134281397641196 0.102388527145735".split(), first="kick"),
    Table("SRKN_14A", "nystrom", 6, "chi",
          "0.0378593198406116 0.053859832783850 0.048775800318585 0.135207369686421 "
          "-0.161075257952980 0.104540892120091 0.209700510951356 -0.204785822176643 "
          "0.074641362659228 0.069119764509130 0.037297935860413 0.291269757886391 "
          "-0.300064001014902 0.103652534528448".split(), first="drift"),
]


def mirrored(drifts, kicks):
    return [w for pair in zip(drifts, kicks) for w in pair] + list(drifts[len(kicks):])


def with_rest(numbers, total):
    numbers = [mpf(n) for n in numbers]
    return numbers + [total - sum(numbers)]


BCE_A = with_rest(
    "0.0505805 0.149999 -0.0551795510771615573511026950361 0.423755898835337951482264998051 "
    "-0.213495353584659048059672194633 -0.0680769774574032619111630736274 "
    "0.227917056974013435948887201671 -0.235373619381058906524740047732 "
    "0.387413869179878047816794031058".split(), mpf(1) / 2)
BCE_B = [mpf(n) for n in
    "0.129478606560536730662493794395 0.222257260092671143423043559581 "
    "-0.0577514893325147204757023246320 -0.0578312262103924910221345032763 "
    "0.103087297437175356747933252265 -0.140819612554090768205554103887 "
    "0.0234462603492826276699713718626 0.134854517356684096617882205068 "
    "0.0287973821073779306345172160211".split()]
BCE_B.append(1 - 2 * sum(BCE_B))

TABLES += [
    Table("BLANES_CASAS_ESCORIHUELA_8", "nystrom", 8, "strokes", mirrored(BCE_A, BCE_B), first="drift"),
    Table("SABA_1", "near-integrable", (2, 2), "strokes", [mpf(1) / 2, 1]),
    Table("SABA_2", "near-integrable", (4, 2), "strokes",
          [(3 - sqrt(3)) / 6, mpf(1) / 2, 1 / sqrt(3)]),
    Table("SABA_3", "near-integrable", (6, 2), "strokes",
          ["0.1127016653792583114820734600217600389167", mpf(5) / 18,
           "0.3872983346207416885179265399782399610833", mpf(4) / 9]),
    Table("SABA_4", "near-integrable", (8, 2), "strokes",
          ["0.06943184420297371238802675555359524745214", "0.1739274225687269286865319746109997036177",
           "0.2605776340045981552106403648947824089476", "0.3260725774312730713134680253890002963823",
           "0.3399810435848562648026657591032447"]),
    Table("ABA_104", "near-integrable", (10, 4), "strokes", mirrored(
          "0.04706710064597250612947887637243678556564 0.1847569354170881069247376193702560968574 "
          "0.2827060056798362053243616565541452479160 -0.01453004174289681837857815229683813033908".split(),
          "0.1188819173681970199453503950853885936957 0.2410504605515015657441667865901651105675 "
          "-0.2732866667053238060543113981664559460630 0.8267085775712504407295884329818044835997".split())),
    Table("ABA_864", "near-integrable", (8, 6, 4), "strokes", mirrored(
          "0.0711334264982231177779387300061549964174 0.241153427956640098736487795326289649618 "
          "0.521411761772814789212136078067994229991 -0.333698616227678005726562603400438876027".split(),
          "0.183083687472197221961703757166430291072 0.310782859898574869507522291054262796375 "
          "-0.0265646185119588006972121379164987592663 0.0653961422823734184559721793911134363710".split())),
    Table("ABA_1064", "near-integrable", (10, 6, 4), "strokes", mirrored(
          "0.03809449742241219545697532230863756534060 0.1452987161169137492940200726606637497442 "
          "0.2076276957255412507162056113249882065158 0.4359097036515261592231548624010651844006 "
          "-0.6538612258327867093807117373907094120024".split(),
          "0.09585888083707521061077150377145884776921 0.2044461531429987806805077839164344779763 "
          "0.2170703479789911017143385924306336714532 -0.01737538195906509300561788011852699719871".split())),
]

TABLES += [
    Processed("PROCESSED_4", "general", 4,
              Table("PROCESSED_4", "general", 4, "chi",
                    "0.18942387299348393 0.22664306546899612 0.15009665742897568 0.29792623628756193 "
                    "-0.3640898321790176".split()),
              "-0.03381636923401766 0.41079318130411496 -0.39058390449081315 -0.2265228565118507 "
              "-0.09543418099840181 -0.1786572773459443 0.10672492980681786 0.21633009791857474 "
              "-0.2208364123696032 0.04470258039852269 0.2889941124285591".split(), layout="twice"),
    Processed("PROCESSED_6", "general", 6,
              Table("PROCESSED_6", "general", 6, "chi",
                    "0.41235344470350144 -0.3988455639773201 0.1797604917202067 -0.29777475418012955 "
                    "0.161460251609708 0.14360883079017303 0.15677272536138287 0.14266457397247756".split()),
              "0.19942106668526377 -0.24520512908294406 0.3731282513951695 -0.33972887794068746 "
              "0.05856291430363041 -0.07944300914711097 -0.25185517486609116 0.14460461604440666 "
              "0.3940476382805705 -0.3903824878114566 -0.29599850408171746 0.32887574004202624 "
              "0.0961158829694107 0.2994991469787901 -0.14069383219797005 0.21113373316350098 "
              "0.41766056686162745 -0.41734517723591424 -0.3027273941637407 -0.34239466006050373 "
              "-0.20884973485118516 0.21245708590647622 0.3067974846170819".split(), layout="twice"),
    Processed("BLANES_CASAS_MURUA_8", "general", 8,
              Table("BLANES_CASAS_MURUA_8", "general", 8, "symmetric",
                    "0.168 0.168 0.585550530805562 -0.460090457516872 0.172863148729731 "
                    "0.179664539695039".split(), complete=True),
              "-0.543415765371656 0.598212975943381 0.236885952363384 -0.511744926116413 "
              "0.162324207599241 0.588351189003849 0.333987768164597 -0.337188967354338 "
              "-0.008488123494574411".split(), layout="symmetric"),
]

TABLES += [
    Mean("MEAN_4", TABLES[-3], 5,
         "0.1120566881706584 -0.2980096237039461 -0.08628892551533857 0.011319292170399361 "
         "0.26092256887822596".split()),
]


def corrector(name, pairs):
    """Wisdom's corrector of order 2·pairs + 1 of Strang's splitting A(h/2) B(h) A(h/2).

    To first order in ε Strang's splitting moves along B' = y/sinh(y) B, y = h ad_A/2, and the corrector
    ∏ A(a) B(b) A(−2a) B(−b) A(a), a = k √(7/40), is exp(Σ 2 b sinh(a h ad_A) B). It takes B' to
    B' + h ad_A Σ 2 b sinh(a h ad_A) B, which is B up to (h ad_A)^(2·pairs).
    """
    spacing = sqrt(mpf(7) / 40)
    times = [k * spacing for k in range(1, pairs + 1)]
    half = taylor(lambda y: y / sinh(y) if y else mpf(1), 0, 2 * pairs)
    wanted = [-half[2 * k] / mpf(4) ** k for k in range(1, pairs + 1)]
    powers = range(1, 2 * pairs, 2)
    rows = matrix([[2 * a**k / factorial(k) for a in times] for k in powers])
    kicks = mp.lu_solve(rows, matrix(wanted))
    strokes = [mpf(0)]
    for a, b in reversed(list(zip(times, kicks))):
        strokes[-1] += a
        strokes += [b, -2 * a, -b, a]
    durations, previous = [], mpf(0)
    for stroke in strokes[:-1]:
        previous = stroke - previous
        durations.append(previous)
    strang = Table("STRANG", "near-integrable", (2, 2), "strokes", [mpf(1) / 2, 1])
    return Processed(name, "near-integrable", (2 * pairs + 2, 2), strang, durations[:-1], fixed=True)


TABLES += [corrector(f"CORRECTOR_{2 * pairs + 1}", pairs) for pairs in (1, 2, 3, 5, 8)]


if __name__ == "__main__":
    wanted = sys.argv[1:]
    for table in TABLES:
        if not wanted or table.name in wanted:
            print(rust(table, polish(table)))
