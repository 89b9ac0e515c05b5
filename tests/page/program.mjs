// The program under test, in a folder of its own.
import { spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

export class Folder {
  constructor() {
    this.path = mkdtempSync(join(tmpdir(), "morepro-page-"));
  }

  file(name) {
    return join(this.path, name);
  }

  write(name, text) {
    writeFileSync(this.file(name), text);
  }

  read(name) {
    return readFileSync(this.file(name), "utf8");
  }

  run(...words) {
    const done = spawnSync(process.env.MOREPRO, words, { cwd: this.path, encoding: "utf8" });
    if (done.status !== 0) throw new Error(`morepro ${words.join(" ")}: ${done.stderr}`);
    return done.stdout;
  }

  /** For a command that may fail. */
  runWithStatus(words) {
    return spawnSync(process.env.MOREPRO, words, { cwd: this.path }).status;
  }

  remove() {
    rmSync(this.path, { recursive: true, force: true });
  }
}

/** The same of a recording, which may begin with lines of metadata. */
export const tableOf = (text) => columnsOf(text.split("\n").filter((line) => !line.startsWith("#")).join("\n"));

/** Columns of a CSV by name. */
export function columnsOf(text) {
  const [head, ...rows] = text.trim().split("\n").map((line) => line.split(","));
  return Object.fromEntries(head.map((name, i) => [name, rows.map((row) => Number(row[i]))]));
}
