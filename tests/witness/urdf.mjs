// URDF read by check_urdf (liburdfdom): it parses, the tree is whole, and the masses and limits in the file are ours.
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { Checks, profileOf, run } from './lib.mjs';

const [model, folder] = process.argv.slice(2);
const stem = path.parse(model).name;
const checks = new Checks(`URDF ${stem}`);
const profile = profileOf(model, path.join(folder, `${stem}.ragdoll.json`));
const file = path.join(folder, `${stem}.urdf`);
run('export', model, '-o', file);
const tree = execFileSync('check_urdf', [file], { encoding: 'utf8' });
checks.that(tree.includes('Successfully Parsed XML'), 'check_urdf parses it');
checks.that(tree.includes(`root Link: ${profile.bodies[0].name} has`), 'the root is the hips');
for (const c of profile.constraints) checks.that(new RegExp(`child\\(\\d+\\):\\s+${c.child}\\n`).test(tree), `${c.child} hangs in the tree`);
const text = fs.readFileSync(file, 'utf8');
for (const body of profile.bodies) {
  const link = text.slice(text.indexOf(`<link name="${body.name}">`));
  checks.near(Number(/<mass value="([^"]+)"/.exec(link)[1]), body.massKg, 1e-6, `mass of ${body.name}`);
}
for (const c of profile.constraints.filter((d) => d.kind === 'hinge')) {
  const joint = text.slice(text.indexOf(`<joint name="${c.child}_z"`));
  const [, low, high] = /lower="([^"]+)" upper="([^"]+)"/.exec(joint);
  checks.near([Number(low), Number(high)], [c.hinge.lower, c.hinge.upper], 1e-6, `limits of ${c.child}`);
}
checks.end();
