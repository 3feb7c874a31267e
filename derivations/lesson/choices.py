"""The thirty mistakes of the lesson, each with the question that a class discusses before it reads the answer."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Choice:
    """One mistake by its name in the catalogue of a mechanism, and its question."""

    kind: str
    n: int
    name: str
    question: str
    question_ja: str


def _double(name: str, question: str, question_ja: str) -> Choice:
    return Choice("n-leg", 2, name, question, question_ja)


def _two_legs(name: str, question: str, question_ja: str) -> Choice:
    return Choice("n-leg", 3, name, question, question_ja)


def _rods(name: str, question: str, question_ja: str) -> Choice:
    return Choice("rod-chain", 2, name, question, question_ja)


CHOICES: tuple[Choice, ...] = (
    _double("sine-cosine-swapped:2:2",
            "At θ₂ = 0 the second rod hangs straight down. Where is its mass then, by this line?",
            "θ₂ = 0 のとき2本目は真下を向きます。この式では質点はどこにありますか。"),
    _double("segment-missing:2:1",
            "Hold θ₂ still and turn θ₁. Does mass 2 move, by this line? Does it in truth?",
            "θ₂ を止めて θ₁ を動かします。この式では質点2は動きますか。実際には？"),
    _double("relative-angle:2",
            "Both rods point the same way, at 30° from the vertical. What is θ₂: 30° or 0°?",
            "2本とも鉛直から30°を向いています。θ₂ は 30° ですか、0° ですか。"),
    _double("inner-derivative-missing:2:1",
            "What unit has each term of this line? Could they be added?",
            "各項の単位は何ですか。足すことができますか。"),
    _double("cosine-derivative-sign:2:1",
            "θ₁ is between 0 and 90° and grows. Does the mass rise or fall? And by this line?",
            "θ₁ が 0 と 90° の間で増えるとき、質点は上がりますか。この式では？"),
    _double("cross-term-missing:2:1:2",
            "Both rods turn alike, stretched out, with θ̇₁ = θ̇₂ = 1. How fast is mass 2, and what does this line say?",
            "2本が一直線のまま θ̇₁ = θ̇₂ = 1 で回ります。質点2の速さは？この式では？"),
    _double("length-missing-in-speed:1:1",
            "What is the unit of the first term? For which length would nobody notice?",
            "最初の項の単位は何ですか。長さがいくつなら誰も気づかないでしょうか。"),
    _double("half-missing:2",
            "Does the mistake change the motion if both kinetic energies have it? And if only one has?",
            "両方の運動エネルギーで ½ を忘れると運動は変わりますか。片方だけなら？"),
    _double("potential-energy-sign:2",
            "By this line, where is mass 2 in stable equilibrium?",
            "この式では、質点2の安定なつり合いの位置はどこですか。"),
    _double("gravity-on-one-mass-only:1",
            "Put m₁ = 0. What does gravity pull on, by this line?",
            "m₁ = 0 とすると、この式では重力は何に働きますか。"),
    _double("height-incomplete:2:1",
            "Turn θ₁ alone: by how much does mass 2 rise? Is that in this line?",
            "θ₁ だけを動かすと質点2はどれだけ上がりますか。この式にありますか。"),
    _double("sum-for-difference",
            "For a single pendulum, which equation would L = T + U give? Which way does it fall?",
            "単振り子で L = T + U とすると、どんな方程式になりますか。どちらへ落ちますか。"),
    _double("inertia-counted-twice:2",
            "A point mass on a massless rod: what is its moment of inertia about its own centre?",
            "質量のない棒の先の質点：自分の重心のまわりの慣性モーメントはいくつですか。"),
    _double("velocity-terms-forgotten",
            "∂L/∂θ̇₁ contains cos(θ₁ - θ₂). Is that constant in time?",
            "∂L/∂θ̇₁ には cos(θ₁ - θ₂) があります。これは時間的に一定ですか。"),
    _double("other-angles-held:1",
            "d/dt cos(θ₁ - θ₂): which of the two angles depend on time?",
            "d/dt cos(θ₁ - θ₂)：2つの角のうち時間によるのはどちらですか。"),
    _double("kinetic-slope-missing",
            "Does the kinetic energy change when only θ₁ is changed, all rates kept?",
            "角速度をそのままにして θ₁ だけを変えると、運動エネルギーは変わりますか。"),
    _double("lagrange-sign:2",
            "For a falling stone, which sign makes d/dt ∂L/∂ẏ and ∂L/∂y into Newton's equation?",
            "落下する石で、d/dt ∂L/∂ẏ と ∂L/∂y をどの符号で結ぶとニュートンの方程式になりますか。"),
    _double("potential-not-differentiated:1",
            "Both rods hang at rest. Which force does this row give?",
            "2本とも静かにぶら下がっています。この式はどんな力を与えますか。"),
    _double("square-not-doubled:1",
            "What is ∂/∂θ̇₁ of ½ θ̇₁²?",
            "½ θ̇₁² を θ̇₁ で偏微分すると何ですか。"),
    _double("sign:2:3:3",
            "Rod 1 whirls, rod 2 lags a little behind. Which way must rod 2 be flung?",
            "棒1が回り、棒2が少し遅れています。棒2はどちらへ振られるはずですか。"),
    _double("divided-on-the-left-only:1",
            "Both sides were divided by l₁. Which terms still have it?",
            "両辺を l₁ で割りました。l₁ が残っている項はどれですか。"),
    _two_legs("wrong-length-in-position:3:3:2",
              "The misprint of Shiki's (2.1). Which length cannot occur in the position of mass 3?",
              "Shiki の (2.1) の誤植です。質点3の位置に現れないはずの長さはどれですか。"),
    _two_legs("hung-from-a-leg:3",
              "From which mass does leg 3 hang? Draw it.",
              "3本目の足はどの質点から吊られていますか。図をかいてください。"),
    _two_legs("legs-coupled:2:3",
              "Hold link 1 fixed. Can leg 2 feel leg 3?",
              "リンク1を固定します。足2は足3の影響を受けますか。"),
    _rods("inertia-missing",
          "Link 1 turns about its fixed middle. By this line, has it any kinetic energy?",
          "棒が固定された中心のまわりに回ります。この式では運動エネルギーがありますか。"),
    _rods("inertia-about-end",
          "m l²/3 or m l²/12: which belongs to the speed of the centre, which to turning about the end?",
          "m l²/3 と m l²/12：重心の速度と組むのはどちらですか。"),
    _rods("centre-at-end",
          "Balance a rod on a finger: where is the finger?",
          "棒を指で水平に支えます。指はどこですか。"),
    _rods("upper-joint-force-missing:2",
          "Nothing pulls at the lower end of the last rod. What turns it about its centre?",
          "最後の棒の下端には力がありません。重心のまわりに棒を回すのは何ですか。"),
    _rods("smaller-for-larger-index",
          "Which rods does the force in joint 2 carry: those below rod 1, or those below rod 2?",
          "継ぎ目の力が支えるのは、棒1より下ですか、棒2より下ですか。"),
    _rods("sum-index-own",
          "The misprint of Takeno's (12): over what does the sum run, and what is added?",
          "Takeno の (12) の誤植です。和は何について取り、何を足しますか。"),
)  # fmt: skip
