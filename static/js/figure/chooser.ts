/**
 * Which level of accuracy a figure shows while something moves: the most accurate whose frame is
 * expected within two display frames, from the event to the pixels; where none is, the quickest.
 *
 * The page chooses, not the worker, since only the page knows when the event came and when its frame
 * was painted. Nothing here reads a clock or touches the document.
 *
 * A time is expected to be `pace × work`: the work of a control's frame at a level, learnt from the
 * recorded costs on, and one pace of the device, learnt sooner, so that a load, or its end, changes
 * what is expected of every level at once. Levels change as bitrates do in adaptive streaming:
 * downwards after two late frames, to what is expected in time; upwards only after a calm without a
 * late frame, to what is expected clearly in time, and after an attempt that failed, only after a calm
 * of twice the length. The delayed switch upwards is that of FESTIVE (Jiang, Sekar & Zhang, CoNEXT
 * 2012), the two thresholds against oscillation are as in BOLA-E (Spiteri, Sitaraman & Sparacio, MMSys
 * 2018). One slow frame changes nothing.
 */

/** Milliseconds of two display frames. */
export const IN_TIME = 1000 / 30;
/** Share of them that leaves room for the wait for a display frame: expected of a new level. */
const CLEARLY = 0.7;
/** Two late frames are too many, one after the other, or among the last ten of a level at its limit. */
const TOO_MANY = 2;
const WINDOW = 10;
/** Milliseconds without a late frame before more is tried; the most, after failures. */
const CALM = 150;
const MOST_CALM = 6400;
/** Milliseconds between two moves that are no longer one drag. */
const PAUSE = 1000;
/** Shares of a surprise that pace and work take; all of it the work of what is new. */
const PACE_LEARNS = 0.4;
const WORK_LEARNS = 0.2;
/** A frame that takes ten times as long as expected counts as one that takes four times as long. */
const MOST_SURPRISE = Math.log(4);
/** How much sooner, as a logarithm, a more accurate level is expected after each calm. */
const HOPE = 0.01;
/** Where nothing is known: how much longer than the level before, as a logarithm. */
const PER_LEVEL = Math.log(2);

/** What a recorded time in milliseconds of Python is in a page, on a desk, there and back. */
const inPage = (ms: number) => 6 + 2 * ms;

/** A scene's levels, from cheap to accurate, and recorded milliseconds by level and control. */
export type Levels = {
  scene: string;
  tiers: string[];
  recorded: Record<string, Record<string, number>>;
};

/** How a control moves. */
type Move = {
  level: number;
  /** When the last event came; long ago once the hand has let go. */
  time: number;
  /** When the last late frame came, or the level began, or more was considered. */
  calmSince: number;
  calm: number;
  /** Which of the last frames of this level were late. */
  late: boolean[];
  /** Whether the level was tried from a cheaper one. */
  isTry: boolean;
};

/** One visit's knowledge of a device. Levels are places in their order, times are milliseconds. */
export class Chooser {
  /** Logarithm of how much slower the device is than a desk. */
  #pace = 0;
  /** Logarithms of the milliseconds of frames at a pace of 1. */
  #work: Map<string, number> = new Map();
  /** How much slower the last frame was than expected, as a logarithm. */
  #slower = 0;
  #moves: Map<string, Move> = new Map();

  /**
   * The level of the next frame while a control moves.
   *
   * @param most The most accurate level that may be shown.
   */
  choose(of: Levels, control: string, most: number, now: number): number {
    const name = key(of, control);
    const last = this.#moves.get(name);
    let move = last;
    if (!move || now - move.time > PAUSE) {
      const level = this.#first(of, control, most, last?.level ?? most);
      const calm = last?.calm ?? CALM;
      move = { level, time: now, calmSince: now, calm, late: [], isTry: false };
    }
    const level = this.#next(of, control, most, move, now);
    if (level !== move.level) {
      const isTry = level > move.level && !move.late.includes(true);
      move = { ...move, level, calmSince: now, late: [], isTry };
    }
    move.time = now;
    this.#moves.set(name, move);
    return move.level;
  }

  /** The hand has let go: the next move of the control is another drag. */
  rest(of: Levels, control: string) {
    const move = this.#moves.get(key(of, control));
    if (move) move.time = -Infinity;
  }

  /**
   * A frame was painted.
   *
   * @param control The control that moved; empty for a frame of which nothing was cached.
   * @param ms From the event to the pixels.
   */
  shown(of: Levels, control: string, level: number, ms: number, now: number) {
    this.#learn(of, control, level, Math.max(ms, 1));
    const move = this.#moves.get(key(of, control));
    if (move?.level !== level || now - move.time > PAUSE) return;
    const late = ms > IN_TIME;
    move.late = [...move.late, late].slice(-WINDOW);
    if (late) move.calmSince = now;
  }

  /** The milliseconds that a frame of a level is expected to take; 0 where nothing is known. */
  expected(of: Levels, control: string, level: number): number {
    const work = this.#workOf(of, control, level);
    return work === null ? 0 : Math.exp(this.#pace + work);
  }

  /** The level that a drag begins with; the last one keeps the benefit of the doubt. */
  #first(of: Levels, control: string, most: number, last: number) {
    return this.#best(of, control, most, (level) => (level === last ? 1 : CLEARLY) * IN_TIME);
  }

  #next(of: Levels, control: string, most: number, move: Move, now: number) {
    const { level, late } = move;
    if (level > most) return this.#first(of, control, most, level);
    const isAtLimit = this.expected(of, control, level) > CLEARLY * IN_TIME;
    const recent = isAtLimit ? late : late.slice(-TOO_MANY);
    if (recent.filter(Boolean).length >= TOO_MANY) return this.#down(of, control, most, move);
    if (late.length < TOO_MANY || now - move.calmSince < move.calm) return level;
    move.calmSince = now;
    if (move.isTry) move.calm = CALM; // it has not failed
    return this.#up(of, control, most, level);
  }

  #down(of: Levels, control: string, most: number, move: Move) {
    const { level } = move;
    const limit = (other: number) => (other < level ? CLEARLY * IN_TIME : 0);
    const next = this.#best(of, control, most, limit);
    const ms = (other: number) => this.expected(of, control, other);
    if (next > level && ms(next) > CLEARLY * ms(level)) return level;
    if (next < level && move.isTry) move.calm = Math.min(2 * move.calm, MOST_CALM);
    return next;
  }

  /** A level clearly in time. Where none is, the next one, slow under a load that may be over, is
   * expected a little sooner, so that it is tried some time. */
  #up(of: Levels, control: string, most: number, level: number) {
    for (let other = most; other > level; other--) {
      if (this.expected(of, control, other) <= CLEARLY * IN_TIME) return other;
    }
    const work = this.#workOf(of, control, level + 1);
    if (level < most && work !== null) this.#work.set(key(of, control, level + 1), work - HOPE);
    return level;
  }

  /** The most accurate level that is expected within its limit; where none is, the quickest. */
  #best(of: Levels, control: string, most: number, limit: (level: number) => number) {
    let [quickest, shortest] = [0, Infinity];
    for (let level = most; level >= 0; level--) {
      const ms = this.expected(of, control, level);
      if (ms <= limit(level)) return level;
      if (ms < shortest) [quickest, shortest] = [level, ms];
    }
    return quickest;
  }

  /** Share a frame's surprise between pace and work; slowness only as far as the next frame, or the
   * last one, confirms it. */
  #learn(of: Levels, control: string, level: number, ms: number) {
    const log = this.#workOf(of, control, level) ?? Math.log(ms) - this.#pace;
    const off = Math.min(Math.log(ms) - this.#pace - log, MOST_SURPRISE);
    const surprise = Math.min(off, Math.max(this.#slower, 0));
    this.#slower = off;
    const name = key(of, control, level);
    const isKnown = this.#work.has(name) || recordedMs(of, control, level) !== undefined;
    this.#work.set(name, log + (isKnown ? WORK_LEARNS : 1) * surprise);
    if (isKnown) this.#pace += PACE_LEARNS * surprise;
  }

  /** Logarithm of the work of a frame: as learnt or recorded, of this level or the nearest one, with
   * this control or from scratch; null where nothing is known. */
  #workOf(of: Levels, control: string, level: number): number | null {
    for (const moved of control ? [control, ""] : [""]) {
      for (let away = 0; away < of.tiers.length; away++) {
        for (const near of [level - away, level + away]) {
          const recorded = recordedMs(of, moved, near);
          const work =
            this.#work.get(key(of, moved, near)) ??
            (recorded === undefined ? undefined : Math.log(inPage(recorded)));
          if (work !== undefined) return work + (level - near) * PER_LEVEL;
        }
      }
    }
    return null;
  }
}

function recordedMs(of: Levels, control: string, level: number) {
  return of.recorded[of.tiers[level]]?.[control];
}

function key(of: Levels, control: string, level?: number) {
  return `${of.scene} ${control} ${level === undefined ? "" : of.tiers[level]}`;
}
