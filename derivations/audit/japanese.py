"""The audit's words in Japanese: sentences of the documents' index and of the answers, and words of tables."""

# ruff: noqa: E501 -- a sentence is a line

from __future__ import annotations

DOCUMENTS = {"shiki": "識", "takeno": "竹野"}
WORDS: dict[str, str] = {
    "document": "文書", "number": "番号", "place": "場所", "verdict": "判定", "what it is": "内容", "formula": "式",
    "printed": "印刷", "right": "正しい式", "why": "理由", "read as": "読み方", "median": "中央値", "most": "最大",
    "small swing": "小さい振れ", "large swing": "大きい振れ", "yes": "はい", "no": "いいえ",
    "holds": "正しい", "holds-if": "条件つきで正しい", "misprint": "誤植", "wrong": "誤り",
    "Printed": "印刷", "Right": "正しい式", "Misprint": "誤植", "Summary": "まとめ", "more than 20 s": "20 s より後",
    "before": "の前", "after": "の後", "first": "1 番目", "second": "2 番目", "third": "3 番目",
    "n": "n", "states": "状態の数", "all positive": "すべて正", "log|A| from": "log|A| 最小", "to": "最大",
    "log|A(0)|": "log|A(0)|", "never below log|A(0)|": "log|A(0)| を下回らない",
    "random states": "ランダムな状態", "system": "系", "rod-chain": "棒の鎖", "n-leg": "N 本足の振り子",
    "smallest eigenvalue of M(θ) met": "現れた M(θ) の最小固有値", "its bound, that of M(0)": "その下界（M(0) の最小固有値）",
    "no rate exceeds, released at rest from anywhere [rad/s]": "どこから静かに放しても越えない角速度 [rad/s]",
    "swing 1": "第 1 振動", "swing 2": "第 2 振動", "swing 3": "第 3 振動",
    "relative error of the rates of the slowest swings": "遅い振動の角振動数の相対誤差",
    "from rest in one bow": "同じ弓形から静かに放す",
    "largest speed of the tip [m/s]": "先端の最大の速さ [m/s]", "at [s]": "その時刻 [s]",
    "largest rate of a rod [rad/s]": "棒の最大の角速度 [rad/s]",
    "tips of n and 2n rods apart until 0.4 s [m]": "0.4 s までの n 本と 2n 本の先端の距離 [m]",
    "graded as a derivation": "導出として採点", "mistakes named": "名指された誤り", "its terms": "その項", "term": "項",
    "what it costs": "その影響", "error of the accelerations, median": "加速度の相対誤差（中央値）",
    "0.1 rad off after [s], small swing": "0.1 rad ずれる時刻 [s]（小さい振れ）", "equations": "方程式", "slow": "遅い", "fast": "速い",
    "small oscillations of two rods of 1 m [rad/s]": "1 m の棒 2 本の小さい振動 [rad/s]",
    "rods' own inertia forgotten": "棒自身の慣性モーメントを忘れた", "inertia-missing": "慣性モーメントの欠落",
    "positions as printed": "位置を印刷どおりに", "Lagrangian as printed": "ラグランジアンを印刷どおりに",
    "l_m read as l_j": "l_m を l_j と読む", "l_m read as l_n": "l_m を l_n と読む",
}  # fmt: skip
SENTENCES: dict[str, str] = {
    "The documents against first principles": "二つの文書と第一原理との照合",
    "Every numbered equation": "番号のある式すべて",
    "Takeno's displays without a number": "竹野の番号のない式",
    "Slips outside the formulas, found by reading": "式の外の誤記（読んで見つけたもの）",
    "And in the stress test (furiko stress -a chain):": "ストレステスト（furiko stress -a chain）での測定（英語）：",
    "Programmed as printed: error of the accelerations, and when the motion is 0.1 rad off":
        "印刷どおりにプログラムした場合：加速度の誤差と、運動が 0.1 rad ずれる時刻",
    "{n} numbered equations: {holds} hold, {holds-if} hold with a condition left unsaid, {misprint} are misprinted. "
    "Of {m} displays of Takeno's without a number {right} hold.":
        "番号のある式 {n} 個：正しい {holds}、書かれていない条件のもとで正しい {holds-if}、誤植 {misprint}。"
        "竹野の番号のない式 {m} 個のうち {right} 個が正しい。",
    "Each is held against first principles as it is printed: in symbols for two to four angles, and in ball arithmetic "
    "at random points for six and ten. What fails is refuted by a proof at a point, and its correction is proved.":
        "どの式も印刷どおりに第一原理と比べた。角が 2〜4 個のときは記号のまま、6 個と 10 個のときはランダムな点で球演算による。"
        "成り立たない式は一点での証明で否定し、訂正した式を証明した。",
    "{n} entries: {holds} hold, {holds-if} hold on a condition, {wrong} are wrong.":
        "{n} 項目：正しい {holds}、条件つきで正しい {holds-if}、誤り {wrong}。",
    # the index
    "where the two masses are": "二つの質点の位置", "where the three masses are": "三つの質点の位置",
    "where the masses are": "質点の位置", "speed of mass 1": "質点 1 の速さ", "speed of mass 3": "質点 3 の速さ",
    "speed of mass 2, from its components to the cosine of the difference": "質点 2 の速さ（成分から角の差の余弦まで）",
    "speeds of the other masses": "ほかの質点の速さ",
    "the Lagrangian, kinetic less potential energy": "ラグランジアン（運動エネルギー − 位置エネルギー）",
    "Lagrange's equations": "ラグランジュの方程式", "the momenta and their time derivatives": "運動量とその時間微分",
    "the Lagrangian's derivatives by the angles": "ラグランジアンの角による微分", "the equations of motion": "運動方程式",
    "the equations of motion, each divided by its length": "長さで割った運動方程式",
    "the equations of motion as matrices": "行列で書いた運動方程式", "the accelerations": "加速度",
    "the equations of motion and the accelerations as matrices": "行列で書いた運動方程式と加速度",
    "the components of the vectors in (3.10)": "(3.10) のベクトルの成分",
    "the entries of the matrices in (3.10)": "(3.10) の行列の成分", "where the joints are": "つなぎ目の位置",
    "where the rods' centres are": "棒の重心の位置", "Newton's equation for each rod": "各棒のニュートンの運動方程式",
    "rotation of each rod about its centre": "重心まわりの回転の方程式",
    "moment of inertia of a rod about its centre": "重心まわりの慣性モーメント",
    "(4) divided by the length": "(4) を長さで割ったもの", "difference of neighbouring joint forces": "隣り合う相互力の差",
    "the joint forces": "相互力", "sum of neighbouring joint forces": "隣り合う相互力の和",
    "the centres by the rods' directions": "棒の方向で書いた重心", "the coefficients in (10)": "(10) の係数",
    "half of a rod and all rods below it": "棒の半分とそれより下の棒すべて",
    "the weight's coefficient in (9)": "(9) の重力の項の係数",
    "the inertia's term in (9) by the rods' directions": "棒の方向で書いた (9) の慣性の項",
    "the coefficients in (14)": "(14) の係数",
    "sum of neighbouring joint forces by the rods' directions": "棒の方向で書いた隣り合う相互力の和",
    "the equations of motion, a rod's own inertia apart": "運動方程式（棒自身の慣性を分けたもの）",
    "the equations of motion of two rods of one length": "同じ長さの 2 本の棒の運動方程式",
    "the coefficients in (18)": "(18) の係数", "the matrices of the equations of motion": "運動方程式の行列",
    "the directions p and q": "方向 p と q", "the moment of the force below": "下端の力のモーメント",
    "the moment of the force above": "上端の力のモーメント", "the sum of (7) over the rods below": "下の棒についての (7) の和",
    "bⱼₖ by the coefficients of (10)": "(10) の係数で書いた bⱼₖ", "bⱼₖ of a rod above": "上の棒の bⱼₖ（k < j）",
    "bⱼⱼ": "bⱼⱼ", "bⱼₖ of a rod below": "下の棒の bⱼₖ（k > j）",
    "the second derivative of a direction": "方向の 2 階微分", "products of the directions": "方向どうしの内積",
    "(6) with (16) in it": "(16) を代入した (6)", "the terms of the own acceleration in (17)": "(17) の θ̈ⱼ の項",
    "the coefficients for rods of one length": "長さが等しいときの係数",
    "symmetry for rods of one length": "長さが等しいときの対称性",
    "the rows written with i are those of i ≠ 1": "i で書かれた行は i ≠ 1 のもの",
    "eᵢ = 1 for every i: the equation defines e by itself, and (3.10) holds for this e alone":
        "すべての i で eᵢ = 1。式は e を自分自身で定義しており、(3.10) はこの e でのみ成り立つ",
    "l₃ in place of l₂ in x₃ and in y₃; the document goes on correctly, with l₃, in (2.4)":
        "x₃ と y₃ の l₂ は l₃。(2.4) では正しく l₃ になっている",
    "l₁² is missing from ½ m₁ θ̇₁² in the second form (it then is no energy unless l₁ = 1); the document goes on correctly, with m₁ l₁² θ̇₁, in (3.6)":
        "第 2 の形の ½ m₁ θ̇₁² に l₁² が抜けている（l₁ = 1 でなければエネルギーにならない）。(3.6) では正しく m₁ l₁² θ̇₁ になっている",
    "l_i in place of l_m: nothing binds m (with equal lengths it makes no difference); the document goes on correctly, with l_i, in (13)":
        "l_m は l_i。m はどこでも定められていない（長さが等しければ違いはない）。(13) では正しく l_i になっている",
    # slips
    "refers to an equation two chapters on": "二つ先の章の式を指している", "refers to chapter 3": "第 3 章の式を指している",
    "divides the constant, not by it": "「定数を割る」では逆の意味になる", "there is no mass 21": "質点 21 はない",
    "θ̈₃ is left out": "θ̈₃ が抜けている",
    "the speed's square is meant; in italics xᵢ is one coordinate of (xᵢ, yᵢ)":
        "速さの 2 乗の意味。斜体の xᵢ は (xᵢ, yᵢ) の一成分",
    "the text says N legs, the sums say n, and n is introduced nowhere": "本文は N 本、和は n で、n はどこにも導入されていない",
    "∩ joins sets, not conditions": "∩ は集合の記号で、条件には使わない", "a string is meant, not a system": "系でなく糸の意味",
    "figure 1 is meant; (1) gives the joints": "図 1 の意味。(1) はつなぎ目の式",
    "figure 3 is meant; (3) is Newton's equation": "図 3 の意味。(3) はニュートンの運動方程式",
    "the centre, a vector everywhere else": "重心。ほかではどこでもベクトル",
    "the second derivatives are collected there; the first derivatives follow":
        "そこでまとめているのは 2 階微分で、1 階微分は後に続く",
    "chapter 1, before (1.3)": "第 1 章 (1.3) の前", "chapter 1, before (1.8)": "第 1 章 (1.8) の前",
    "chapter 1, before (1.9)": "第 1 章 (1.9) の前", "chapter 2, before (2.3)": "第 2 章 (2.3) の前",
    "chapter 2, before (2.9)": "第 2 章 (2.9) の前", "chapter 2, before (2.12)": "第 2 章 (2.12) の前",
    "(1.4), (2.5), (3.4), first forms": "(1.4)、(2.5)、(3.4) の第 1 の形", "chapter 3, from (3.4) on": "第 3 章 (3.4) 以降",
    "section 2, first paragraph": "第 2 節第 1 段落", "section 2, second paragraph": "第 2 節第 2 段落",
    "section 4, before (4)": "第 4 節 (4) の前", "section 5, before (18)": "第 5 節 (18) の前",
    "|ẋᵢ|² with x in italics": "|ẋᵢ|²（x が斜体）", "|ẋᵢ|² with x in bold": "|ẋᵢ|²（x が太字）",
    "n, in the sums up to n + 1": "n（n + 1 までの和）", "N, the number of legs": "N（足の本数）",
    "r_j in italics": "r_j（斜体）", "r_j in bold": "r_j（太字）",
    # Takeno's section 6
    "Takeno, section 6: is |A(θ)| ≠ 0 for every n?": "竹野 6 節：すべての n で |A(θ)| ≠ 0 か",
    "Yes, for every n, all lengths and all angles: det A(θ) > 0, and it is smallest where the chain is straight.":
        "はい。すべての n、長さ、角で det A(θ) > 0 であり、鎖がまっすぐなとき最小になる。",
    "Takeno, section 6: do the solutions of (22) exist for all times?": "竹野 6 節：(22) の解は大域的に存在するか",
    "Yes: every solution exists for all times, past and future; so do those of Shiki's (3.10).":
        "はい。どの解も過去と未来のすべての時刻で存在する。識の (3.10) の解も同じ。",
    "Takeno, section 6: which equations did Wikipedia give in November 2018?":
        "竹野 6 節：2018 年 11 月の Wikipedia の方程式はどのようなものだったか",
    "Takeno, section 6: what becomes of (22) for n → ∞, the total length being fixed?":
        "竹野 6 節：全長を一定にして n → ∞ とすると (22) はどうなるか",
    "Takeno, section 6: why does the end of the chain move so violently when n is large?":
        "竹野 6 節：n が大きいと先の方の動きが激しくなるのはなぜか",
    "With D = diag(ρ l_j), M(θ) = D A(θ) is the matrix of the kinetic energy, ½ θ̇ᵀ M θ̇ = Σ ½ ∫ |v|² dm. It is zero only if every point of every rod rests, that is if θ̇ = 0: M is positive definite and det A = det M / Π ρ l_j > 0. Entry by entry, M_jk(θ) = M_jk(0) · cos(θ_j - θ_k), and the matrix of cosines is c cᵀ + s sᵀ with c = (cos θ_j), s = (sin θ_j): positive semidefinite with ones on its diagonal. Oppenheim's inequality then gives det M(θ) ≥ det M(0) > 0.":
        "D = diag(ρ l_j) とすると M(θ) = D A(θ) は運動エネルギーの行列で、½ θ̇ᵀ M θ̇ = Σ ½ ∫ |v|² dm。これが 0 になるのはすべての棒のすべての点が静止するとき、つまり θ̇ = 0 のときだけなので、M は正定値で det A = det M / Π ρ l_j > 0。成分ごとに M_jk(θ) = M_jk(0) · cos(θ_j - θ_k) であり、余弦の行列は c = (cos θ_j)、s = (sin θ_j) として c cᵀ + s sᵀ、すなわち対角成分が 1 の半正定値行列である。よってオッペンハイムの不等式から det M(θ) ≥ det M(0) > 0。",
    "A(θ) is invertible and smooth, so that θ̈ = f(θ, θ̇) with smooth f, and a solution can only end by leaving every bounded set of rates. It cannot: the energy E = ½ θ̇ᵀ M(θ) θ̇ + U(θ) is constant and U is bounded below, while the smallest eigenvalue of M(θ) is never below that of M(0) (M(θ) is the entrywise product of M(0) with a positive semidefinite matrix with ones on its diagonal). Hence |θ̇|² ≤ 2 (E - min U) / λ_min(M(0)) at all times; the squares of the rates in (22) do no harm.":
        "A(θ) は可逆で滑らかだから θ̈ = f(θ, θ̇)（f は滑らか）と書け、解が途切れるのは角速度が有界でなくなるときに限る。しかしそれは起こらない。エネルギー E = ½ θ̇ᵀ M(θ) θ̇ + U(θ) は一定で U は下に有界であり、M(θ) の最小固有値は M(0) のそれを下回らない（M(θ) は M(0) と、対角成分が 1 の半正定値行列との成分ごとの積）。したがって常に |θ̇|² ≤ 2 (E - min U) / λ_min(M(0)) であり、(22) の角速度の 2 乗は妨げにならない。",
    "In the joints' displacements the linearised (18) is two tridiagonal matrices, of kinetic and potential energy; for l → 0 they are the finite elements of (T y′)′ = ρ ÿ with the tension T = ρ g (L − s), whose solutions are Bessel's J₀. That (22) is not explicit is no obstacle: the accelerations of n rods cost O(n) operations, by recursion from link to link.":
        "つなぎ目の変位で書くと、線形化した (18) は運動エネルギーと位置エネルギーの二つの三重対角行列になる。これは張力 T = ρ g (L − s) の方程式 (T y′)′ = ρ ÿ の有限要素で、その解はベッセル関数 J₀。(22) が陽でないことは障害にならない。n 本の棒の加速度は、棒から棒への漸化式により O(n) の演算で求まる。",
    "The hanging chain: its small swings converge to Bernoulli's, ω_k = (j₀,k/2) √(g/L), with errors that fall as 1/n². Large motions converge, too, as measured, for as long as they are smooth.":
        "ぶらさがった「くさり」になる。小さい振動はベルヌーイの ω_k = (j₀,k/2) √(g/L) に収束し、誤差は 1/n² で減る。大きな運動も、滑らかな間は収束することが測定でわかる。",
    "Every n starts from rest in one curve, 1 m long. Before the crack the tips of n and of 2n rods come together; at the crack, at nearly the same time for all n, the rate of the last rod more than doubles whenever n does, while the speed of the tip gains little more than 1 m/s: what turns is ever shorter. An integrator needs steps that fall with n, because finer chains resolve more of the kink; with them it keeps the energy. A scheme without error control breaks there, and that looks like a fault of the equations.":
        "どの n も長さ 1 m の同じ曲線から静かに放す。鞭が鳴る前は n 本と 2n 本の先端が近づいていく。鳴る瞬間（どの n でもほぼ同じ時刻）には、最後の棒の角速度は n が 2 倍になるごとに 2 倍以上になるが、先端の速さは 1 m/s あまりしか増えない。回る部分がますます短くなるからである。n が大きいほど折れ目が細かく表されるため、積分の刻みは n とともに小さくしなければならないが、そうすればエネルギーは保たれる。誤差を制御しない解法はそこで破綻し、方程式の誤りのように見える。",
    "It is physics, not numerics: the chain cracks like a whip. Until then the tip converges as n grows; at the crack the curve has a kink at its free end, where the tension vanishes.":
        "数値計算ではなく物理である。くさりは鞭のように鳴る。それまでは n が大きくなると先端の運動は収束し、鳴る瞬間に、張力が 0 になる自由端で曲線に折れ目ができる。",
    "Without ½ I θ̇², I = m l²/12, Lagrange's equations of two equal rods are (19) with 4/3 - 1/12 = 5/4 and 1/3 - 1/12 = 1/4. Graded as a derivation, they are wrong, and only that mistake is named.":
        "½ I θ̇²（I = m l²/12）を落とすと、等しい 2 本の棒のラグランジュの方程式は (19) で 4/3 - 1/12 = 5/4、1/3 - 1/12 = 1/4 としたものになる。導出として採点すると誤りで、名指されるのはこの誤りだけである。",
    "With the diagonal coefficients 5/4 and 1/4 in place of 4/3 and 1/3: each rod turned into a point mass at its middle (reconstructed from the remark; the other difference, the factor of g, is described there as a slip of writing and not what it was).":
        "対角成分の係数が 4/3、1/3 でなく 5/4、1/4 のもの。各棒を中央の質点とみなしている（竹野の記述からの復元。もう一つの違いである g の係数については、記載ミスとだけ書かれていて内容はわからない）。",
}  # fmt: skip
